// mpirun -n 3 bench-ours-mpi FILM whole|inbetween|film|latency [FOLDER]: the host and two nodes
#include <stdexcept>

#include "hal/mpi/start.h"
#include "hal/nx/nx_messages.h"
#include "host/programs/node_job.h"
#include "tests/bench/peers/ours.h"

int main(int argc, char** argv) {
  using namespace mars;
  return mpi::run_mpi(argc, argv, mpi::Role::by_rank, [](int count, char** words) {
    if (count != 3 && count != 4)
      throw std::runtime_error("usage: bench-ours-mpi FILM whole|inbetween|film|latency [FOLDER]");
    if (mynode() == myhost())
      bench::compete(words[1], bench::course_of(words[2]), "MPI", count == 4 ? words[3] : "");
    else
      programs::run_node_job();
    return 0;
  });
}
