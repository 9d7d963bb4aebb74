// mars-simulated: host and nodes on simulated machines, in this process. Frames are drawn; their times are counted.
#include <malloc.h>
#include <sys/prctl.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "hal/failure/explain.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_messages.h"
#include "hal/simulated/run_simulated.h"
#include "host/child/standard_streams.h"
#include "host/experiments/platform.h"
#include "host/programs/counted_writer.h"
#include "host/programs/prediction.h"
#include "host/programs/simulated_files.h"
#include "host/render/sinks/counted_files.h"
#include "host/shell/job/render_job.h"
#include "host/cli/program.h"
#include "node/firmware.h"
#include "node/wire/work.h"

namespace mars::programs {
namespace {

// Frames that go nowhere are counted as files where the options say who writes them. The counting sink ends with the
// job.
void charge_files(session::RenderJob& job, const experiments::Platform& platform, simulated::World& world) {
  const auto counted = std::make_shared<std::optional<sinks::CountedFiles>>();
  job.make_sinks = [serve = serve_files(world, job.form.format), counted, counts = job.counts_files,
                    format = job.form.format,
                    part = platform.file_part](sinks::Sink& sink, const sinks::SinkPool::Shape& shape) {
    if (!counts) return std::make_unique<sinks::ServedSinks>(sink, shape, serve);
    counted->emplace(images::PictureBands(format, shape.width, shape.height, images::Compression::zip, {},
                                          wire::layers_of(shape.format), wire::layered_samples_of(shape.format)),
                     part);
    return std::make_unique<sinks::ServedSinks>(**counted, shape, serve);
  };
}

void run(const options::RenderOptions& options, const experiments::Platform& platform) {
  simulated::World* the_world = nullptr;  // once the host runs, which sends nodes what they do
  const auto host = [&](simulated::World& world) {
    the_world = &world;
    session::RenderJob job = job::job_of(options, "simulated");
    job.adapts = platform.machine.is_uneven();
    job.host = {platform.host_memory, platform.host_processors()};
    job.counts_files = options.sink == options::SinkKind::none && job.writers != session::Writers::automatic;
    charge_files(job, platform, world);
    if (job.counts_files && job.writers == session::Writers::nodes) job.writing = counted_writing();
    predict_on(platform, job);
    session::run_session(job);
  };
  const auto make_writer = [&](const wire::PackedFilm& film, std::span<const std::byte>) {
    const images::PictureBands bands(options.format, film.settings().width, film.settings().height,
                                     images::Compression::zip, {}, options.layers.kinds, film.settings().samples);
    return std::make_unique<CountedWriter>(bands, platform, *the_world, static_cast<int>(mynode()));
  };
  const auto node = [&] {
    const std::string computer = platform.name + std::to_string(messages::machine_neighbourhood().machine);
    node::run_node({.host = computer,
                    .binding = "",
                    .seat = {-1, -1, -1, -1, -1},
                    .memory = platform.memory,
                    .simd = "",
                    .make_frame_writer = make_writer});
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
