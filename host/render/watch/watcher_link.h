// The connection to a watcher's socket, which may come and go.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "host/child/descriptor.h"

namespace mars::watch {

class WatcherLink {
 public:
  // Throws Failure where no socket can have the name.
  explicit WatcherLink(const std::string& socket);

  bool connected() const { return socket_.open(); }
  // Tries at once; "": it is connected, else why not.
  std::string connect();
  // Waits until the watcher has taken it, or is gone, or `give_up` says so, which is asked some times a second; then it
  // is no longer connected.
  void send(std::span<const std::byte> bytes, const std::function<bool()>& give_up);
  // Notices a watcher that is gone.
  void look();

 private:
  std::string name_;
  child::Descriptor socket_;
};

}  // namespace mars::watch
