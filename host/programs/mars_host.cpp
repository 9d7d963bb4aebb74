// mars-host: the rank of an MPI job that reads the film, gives out the work and writes the frames.
#include "hal/mpi/start.h"
#include "host/shell/job/render_job.h"

int main(int argc, char** argv) {
  using namespace mars;
  constexpr const char* kPurpose =
      "The host of a rendering: mpirun -n 1 mars-host FILM -o DIR : -n 4 mars-node";
  host::RenderOptions options;
  if (const auto code =
          host::read_render_options(host::Program::host, "mars-host", kPurpose, options, argc, argv)) {
    return *code;
  }
  return hal::run_mpi(argc, argv, hal::Role::host, [&](int, char**) {
    host::run_session(host::job_of(options, "mpi"));
    return 0;
  });
}
