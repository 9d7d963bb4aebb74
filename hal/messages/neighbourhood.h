// Nodes that are on one machine.
#pragma once

#include <string>

namespace mars::messages {

// The nodes of one node's machine.
struct Neighbourhood {
  int machine = 0;        // lowest node id on it
  int index = 0;          // of this node among them, in order of node id
  int count = 1;          // of them
  int rank = 0;           // of this node in the job that started it (MPI's)
  bool placed = false;    // each was started on processors of its own: do not bind them again
  std::string refusal{};  // why they cannot share memory; "": they can
};

}  // namespace mars::messages
