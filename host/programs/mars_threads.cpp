// mars-threads: host and nodes as threads of one process, where there is no MPI, and for debuggers.
#include <exception>
#include <iostream>

#include "hal/failure/explain.h"
#include "hal/threads/run_threads.h"
#include "host/child/standard_streams.h"
#include "host/programs/prediction.h"
#include "host/programs/node_job.h"
#include "host/shell/options/render_options.h"
#include "host/cli/program.h"
#include "topology/machine.h"

int main(int argc, char** argv) {
  using namespace mars;
  child::prepare_standard_streams();
  constexpr const char* kPurpose = "Host and nodes in one process: mars-threads FILM -o DIR --nodes 4";
  options::RenderOptions options;
  if (const auto code =
          options::read_render_options(options::Program::threads, "mars-threads", kPurpose, options, argc, argv)) {
    return *code;
  }
  try {
    const topology::Machine machine = topology::Machine::here();
    if (options.nodes == 0) options.nodes = static_cast<std::uint32_t>(machine.processors());
    options::check_nodes(options, static_cast<std::uint32_t>(machine.cores()));
    programs::check_memory_limit(options.nodes);
    threads::run_threads(
        static_cast<int>(options.nodes), [&] { programs::render_here(options, "threads"); },
        [&] { programs::run_node_job(options.nodes); });
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "mars: " << reason_of(failure) << '\n';
    return cli::kFailed;
  }
}
