// mars-simulated: host and nodes on simulated machines, in this process. Frames are drawn; their times are counted.
#include <malloc.h>
#include <sys/prctl.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>

#include "hal/failure/explain.h"
#include "hal/messages/shared_memory.h"
#include "hal/simulated/run_simulated.h"
#include "host/child/standard_streams.h"
#include "host/experiments/platform.h"
#include "host/programs/prediction.h"
#include "host/render/sinks/served_sinks.h"
#include "host/shell/job/render_job.h"
#include "host/cli/program.h"
#include "node/firmware.h"
#include "node/wire/work.h"

namespace mars::programs {
namespace {

// Files are work on processors of the host's machine; it is woken when a frame is done.
double serve_files(simulated::World& world, images::PictureFormat format, std::uint64_t bytes) {
  const auto cost = [&](wire::Work kind) { return world.machine().work[static_cast<std::size_t>(kind)]; };
  const double seconds =
      cost(wire::Work::sink_frame) + cost(experiments::sink_byte(format)) * static_cast<double>(bytes);
  const double end = world.reserve(world.nodes(), seconds);
  world.set_alarm(world.nodes(), end);
  return end;
}

void run(const options::RenderOptions& options, const experiments::Platform& platform) {
  const auto host = [&](simulated::World& world) {
    session::RenderJob job = job::job_of(options, "simulated");
    job.adapts = false;  // a platform's computers are all as fast
    job.host = {platform.host_memory, platform.host_processors()};
    const auto serve = [&world, files = platform.charges_files || !job.folder.empty(),
                        format = job.format](std::uint64_t bytes) {
      return files ? serve_files(world, format, bytes) : world.clock(world.nodes());
    };
    job.make_sinks = [serve](sinks::Sink& sink, const sinks::SinkPool::Shape& shape) {
      return std::make_unique<sinks::ServedSinks>(sink, shape, serve);
    };
    predict_on(platform, job);
    session::run_session(job);
  };
  const auto node = [&] {
    const std::string computer = platform.name + std::to_string(messages::machine_neighbourhood().machine);
    node::run_node({computer, "", {-1, -1, -1, -1, -1}, platform.memory, ""});
  };
  simulated::run_simulated(platform.machine, static_cast<int>(options.nodes), host, node);
}

// One rank runs at a time and gives its memory back: large pages would keep more of it than is used, and a heap for
// each thread as much as its ranks ever used.
void spare_memory() {
  prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, 1 << 25);
}

}  // namespace
}  // namespace mars::programs

int main(int argc, char** argv) {
  using namespace mars;
  programs::spare_memory();
  child::prepare_standard_streams();
  constexpr const char* kPurpose =
      "Host and nodes on simulated machines: mars-simulated FILM --sink none --nodes 64 --platform fat-tree";
  options::RenderOptions options;
  options.backend = options::Backend::simulated;
  if (const auto code =
          options::read_render_options(options::Program::simulated, "mars-simulated", kPurpose, options, argc, argv)) {
    return *code;
  }
  try {
    if (options.nodes == 0) options.nodes = 1;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
    programs::run(options, experiments::read_platform(options.platform.empty() ? "fat-tree" : options.platform,
                                                      experiments::platforms_folder(self)));
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "mars: " << reason_of(failure) << '\n';
    return cli::kFailed;
  }
}
