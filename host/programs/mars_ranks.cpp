// mars-ranks: host and nodes as one program, for starters that want only one: rank 0 is the host.
#include "hal/mpi/start.h"
#include "hal/nx/nx_messages.h"
#include "host/child/standard_streams.h"
#include "host/programs/prediction.h"
#include "host/programs/node_job.h"
#include "host/shell/launch/session_folders.h"
#include "host/shell/options/render_options.h"

int main(int argc, char** argv) {
  using namespace mars;
  child::prepare_standard_streams();
  constexpr const char* kPurpose = "Host and nodes in one program, by rank: mpirun -n 5 mars-ranks FILM -o DIR";
  options::RenderOptions options;
  if (const auto code =
          options::read_render_options(options::Program::ranks, "mars-ranks", kPurpose, options, argc, argv)) {
    return *code;
  }
  launch::clean_machine_as_rank();
  return mpi::run_mpi(argc, argv, mpi::Role::by_rank, [&](int, char**) {
    if (mynode() == myhost())
      programs::render_here(options, "mpi");
    else
      programs::run_node_job();
    return 0;
  });
}
