// A process of the studio's that is, or starts, a host: its lines as they come, and why it ended.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "host/child/process.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

class HostProcess {
 public:
  struct Listener {
    std::function<void(const std::string& line)> warned;
    std::function<void(const child::Ending& ending, const std::string& reason)> ended;  // reason: one line; "" if well
  };
  using Start = std::function<std::unique_ptr<child::Process>(const child::ProcessSetup&)>;

  // Throws Failure where no process can be started. `grace`: at its end, before it is asked to end: mostly it has ended
  // by then where its host has seen that the studio closed the socket.
  HostProcess(boost::asio::io_context& context, const Start& start, std::chrono::seconds grace, Listener listener);
  ~HostProcess();  // waits some seconds for the process to end; nothing is called from then on
  HostProcess(const HostProcess&) = delete;
  HostProcess& operator=(const HostProcess&) = delete;

  void stop();

 private:
  class Streams;
  std::shared_ptr<Streams> streams_;
};

}  // namespace mars::studio
