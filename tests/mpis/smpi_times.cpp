// The times of messages and collectives on nodes that SimGrid simulates.
#include "hal/mpi/start.h"
#include "hal/nx/nx_messages.h"
#include "tests/mpis/times.h"

namespace {

int measure(int, char**) {
  if (mynode() != myhost()) mars::times::measure_all();
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return mars::mpi::run_mpi(argc, argv, mars::mpi::Role::by_rank, measure); }
