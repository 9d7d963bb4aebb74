// Our MPI calls return their errors instead of ending the job; succeed() makes a Failure of one.
#pragma once

#include <string>

#include <mpi.h>

namespace mars::mpi {

// Throws a Failure naming `call` and MPI's own reason for `code`.
[[noreturn]] void fail_in_mpi(int code, const char* call);

// Calls fail_in_mpi() unless `code` is success.
inline void succeed(int code, const char* call) {
  if (code != MPI_SUCCESS) [[unlikely]]
    fail_in_mpi(code, call);
}

int size_of(MPI_Comm comm);
// Of the calling process.
int rank_in(MPI_Comm comm);

// Prints `reason` on standard error and ends all ranks with exit code 1, waiting for none.
[[noreturn]] void abort_job(const std::string& reason);

}  // namespace mars::mpi
