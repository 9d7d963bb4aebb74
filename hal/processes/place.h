// The place in a job over shared memory that a process gets from the one that started it, and the requests of a host.
#pragma once

#include <cstdint>
#include <optional>

namespace mars::processes {

struct Place {
  int index = 0;     // of its slot
  int segment = -1;  // descriptors that it inherits: of the segment,
  int socket = -1;   // and of the socket to the job; -1: not the host
};

// For the environment of a process that is about to become another program.
void leave_place(const Place& place);
// Taken from there, by that program. None: it was not started as a rank.
std::optional<Place> take_place();

// One datagram from host to job, answered by one int: 0 or an errno.
struct JobRequest {
  enum class What : std::int32_t {
    begin,  // start every node that has not been loaded, as the job plans
    load,   // start `file` on `node`
    kill,   // end the process on `node`, -1: on all, and wait until it has gone
  };
  What what;
  std::int32_t node;
  char file[4096];
};

}  // namespace mars::processes
