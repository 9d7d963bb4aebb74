// The host's commands in the order in which they came. Those of live views are received while one is executed, where it
// asks whether it is still wanted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace mars::node {

class CommandQueue {
 public:
  // Waits for the next command; says its type.
  long wait();
  // Whether there is one, so that wait() returns at once.
  bool has_come() const;
  // Receives the one that was waited for; valid until the next.
  std::span<const std::byte> receive();
  void reserve(std::size_t bytes) { command_.reserve(bytes); }

  // Whether a BeginView or CloseView of this view has come behind the command being executed, or a Load.
  bool ends(std::uint32_t view);

 private:
  struct Ahead {
    long type;
    std::vector<std::byte> message;
  };

  void receive_ahead();

  std::deque<Ahead> ahead_;  // not executed yet
  bool load_comes_ = false;  // behind these
  long type_ = 0;            // of the command that was waited for
  std::vector<std::byte> command_;
};

}  // namespace mars::node
