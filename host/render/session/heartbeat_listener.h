// What every host does while it beats: it reports, and ends on SIGTERM.
#pragma once

#include <string>

#include "host/render/farm/heartbeats.h"
#include "host/render/session/event_reporter.h"
#include "host/render/session/termination.h"

namespace mars::session {

// Both must outlive it.
farm::HeartbeatListener heartbeat_listener(const EventReporter& reporter, Termination& termination);

// This machine's, as beats name it.
std::string host_name();

}  // namespace mars::session
