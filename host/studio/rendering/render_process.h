// `mars render` as a child: its lines as they come, and why it ended.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/child/command.h"
#include "host/child/process.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

class RenderProcess {
 public:
  struct Listener {
    std::function<void(const std::string& line)> warned;
    std::function<void(const child::Ending& ending, const std::string& reason)> ended;  // reason: one line; "" if well
  };

  // Throws Failure where no process can be started.
  RenderProcess(boost::asio::io_context& context, const child::Command& command, Listener listener);
  ~RenderProcess();  // it ends within some seconds, or is killed; nothing is called from then on
  RenderProcess(const RenderProcess&) = delete;
  RenderProcess& operator=(const RenderProcess&) = delete;

  void stop();

 private:
  class Streams;
  std::shared_ptr<Streams> streams_;
};

}  // namespace mars::studio
