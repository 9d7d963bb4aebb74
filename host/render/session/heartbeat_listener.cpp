#include "host/render/session/heartbeat_listener.h"

#include <unistd.h>

#include <vector>

#include "node/wire/protocol.h"
#include "topology/debugger.h"

namespace mars::session {

farm::HeartbeatListener heartbeat_listener(const EventReporter& reporter, Termination& termination) {
  farm::HeartbeatListener listener;
  listener.beat = [&](const std::string& doing, const auto& silent) { reporter.report_beat(doing, silent); };
  listener.asked_to_end = [&] { return termination.asked(); };
  listener.end = [&](const std::vector<farm::NodeFrame>& drawing) {
    reporter.report_drawing(drawing);
    termination.end();
  };
  listener.is_traced = [](std::int32_t process) { return topology::is_traced(process); };
  return listener;
}

std::string host_name() {
  char name[sizeof wire::Beat::host] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace mars::session
