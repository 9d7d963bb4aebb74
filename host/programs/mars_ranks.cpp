// mars-ranks: host and nodes as one program, for starters that want only one: rank 0 is the host.
#include "hal/mpi/start.h"
#include "hal/nx/nx_messages.h"
#include "host/programs/node_job.h"
#include "host/shell/job/render_job.h"

int main(int argc, char** argv) {
  using namespace mars;
  constexpr const char* kPurpose =
      "Host and nodes in one program, by rank: mpirun -n 5 mars-ranks FILM -o DIR";
  host::RenderOptions options;
  if (const auto code =
          host::read_render_options(host::Program::ranks, "mars-ranks", kPurpose, options, argc, argv)) {
    return *code;
  }
  return hal::run_mpi(argc, argv, hal::Role::by_rank, [&](int, char**) {
    if (mynode() == myhost())
      host::run_session(host::job_of(options, "mpi"));
    else
      host::run_node_job();
    return 0;
  });
}
