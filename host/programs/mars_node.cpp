// mars-node: a rank of an MPI job that renders. Takes no arguments: it does what the host says.
#include "hal/mpi/start.h"
#include "host/programs/node_job.h"

int main(int argc, char** argv) {
  return mars::hal::run_mpi(argc, argv, mars::hal::Role::node, [](int, char**) {
    mars::host::run_node_job();
    return 0;
  });
}
