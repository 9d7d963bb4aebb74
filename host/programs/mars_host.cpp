// mars-host: the rank of an MPI job that reads the film, gives out the work and writes the frames.
#include "hal/mpi/start.h"
#include "host/child/standard_streams.h"
#include "host/programs/prediction.h"
#include "host/shell/launch/session_folders.h"
#include "host/shell/options/render_options.h"

int main(int argc, char** argv) {
  using namespace mars;
  child::prepare_standard_streams();
  constexpr const char* kPurpose = "The host of a rendering: mpirun -n 1 mars-host FILM -o DIR : -n 4 mars-node";
  options::RenderOptions options;
  if (const auto code =
          options::read_render_options(options::Program::host, "mars-host", kPurpose, options, argc, argv)) {
    return *code;
  }
  launch::clean_machine_as_rank();
  return mpi::run_mpi(argc, argv, mpi::Role::host, [&](int, char**) {
    programs::render_here(options, "mpi");
    return 0;
  });
}
