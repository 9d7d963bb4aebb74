// The host of a studio: instead of rendering a film to files it draws what a studio requests over a local socket
// (host/render/pictures/messages.h), until the studio closes that. Nodes keep the views (node/wire/protocol.h); the
// host gives each keyframe to all of them and each inbetween to one that is idle, and composes what they send. While
// nothing is requested it sleeps.
#pragma once

#include <cstdint>
#include <string>

#include "node/wire/protocol.h"

namespace mars::serve {

struct Serving {
  std::string socket;   // the studio's
  std::string backend;  // its name: mpi or threads
  wire::Mapping mapping = wire::Mapping::cost;
  std::uint32_t block = 16;  // side of the compositor's blocks, pixels
};

// The calling HAL process is the host. Returns when the studio has closed the socket and nodes have been sent the
// command to end. Reports events on standard output. A failure is reported as a fault event and to the studio, and
// thrown for the caller, which ends the run.
void serve(const Serving& serving);

}  // namespace mars::serve
