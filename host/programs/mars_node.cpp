// mars-node: a rank of an MPI job that renders. Takes no options: it does what the host says.
#include <exception>
#include <iostream>

#include "hal/failure/explain.h"
#include "hal/mpi/start.h"
#include "host/child/standard_streams.h"
#include "host/programs/node_job.h"
#include "host/cli/program.h"
#include "host/shell/launch/session_folders.h"

int main(int argc, char** argv) try {
  using namespace mars;
  child::prepare_standard_streams();
  cli::Program words("mars-node", "A node of a rendering: mpirun -n 1 mars-host FILM -o DIR : -n 4 mars-node");
  if (const auto code = words.read(argc, argv)) return *code;
  launch::clean_machine_as_rank();
  return mpi::run_mpi(argc, argv, mpi::Role::node, [](int, char**) {
    programs::run_node_job();
    return 0;
  });
} catch (const std::exception& failure) {
  std::cerr << "mars-node: " << mars::reason_of(failure) << '\n';
  return mars::cli::kFailed;
}
