// The tests of NX, written once for all backends: each body is run by every rank, host and nodes, at several
// numbers of nodes (nx_threads_test.cpp, nx_mpi_test.cpp). A body receives every message it sends.
#pragma once

#include <ostream>
#include <vector>

namespace mars::hal {

struct NxBody {
  const char* name;
  void (*run)();
};

inline std::ostream& operator<<(std::ostream& out, const NxBody& body) { return out << body.name; }

std::vector<NxBody> messages_bodies();
std::vector<NxBody> handlers_bodies();
std::vector<NxBody> global_bodies();

// Returns when all ranks have called it.
void meet();

}  // namespace mars::hal
