#include "hal/mpi/mpi_call.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "hal/failure/failure.h"

namespace mars::mpi {
namespace {

// MPI_Abort waits for mpirun, which may hang too, or be stopped: the alarm ends the process then.
constexpr unsigned kLongestAbort = 5;  // seconds

}  // namespace

void fail_in_mpi(int code, const char* call) {
  char reason[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, reason, &length);
  int rank = -1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  throw Failure(std::string(call) + " failed: " + reason, "MPI rank " + std::to_string(rank),
                "the cluster's MPI or network is at fault; see what mpirun says besides");
}

int size_of(MPI_Comm comm) {
  int size = 0;
  succeed(MPI_Comm_size(comm, &size), "MPI_Comm_size");
  return size;
}

int rank_in(MPI_Comm comm) {
  int rank = 0;
  succeed(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
  return rank;
}

void abort_job(const std::string& reason) {
  std::fprintf(stderr, "mars: %s\n", reason.c_str());
  std::fflush(nullptr);
  // At a call of MPI_Abort MPICH's mpirun may end before it has passed on the reason; a rank that ends without a
  // word to it ends all others as well, and its own words come first.
#ifndef MPICH_VERSION
  std::signal(SIGALRM, SIG_DFL);
  alarm(kLongestAbort);
  MPI_Abort(MPI_COMM_WORLD, 1);
#endif
  std::_Exit(1);
}

}  // namespace mars::mpi
