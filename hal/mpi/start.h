// Starts a rank of an MPI job as the host or a node: the start of the MPI backend. mpi.h is known only below hal/mpi/.
// One job has one host and at least one node, in one program or several (mpirun -n 1 mars-host : -n 8 mars-node); the
// nodes are numbered by place (topology/placement.h), else in the order of their ranks.
#pragma once

#include <functional>

namespace mars::mpi {

enum class Role {
  host,
  node,
  by_rank,  // rank 0 is the host, the others are nodes
};

// Runs `body` as this rank; NX calls work in it, on the calling thread. Returns the exit code of the program:
// body's own, once all ranks' bodies have returned, or 1 when the roles do not fit. If body throws, its
// failure is printed on standard error and all ranks are ended, with exit code 1.
int run_mpi(int& argc, char**& argv, Role role, const std::function<int(int argc, char** argv)>& body);

}  // namespace mars::mpi
