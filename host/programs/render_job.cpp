#include "host/programs/render_job.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

#include "hal/nx.h"
#include "host/events/events.h"
#include "host/farm/farm.h"
#include "host/film/compile.h"
#include "host/report/report.h"
#include "host/sinks/checksum.h"
#include "host/sinks/frame_folder.h"
#include "host/sinks/sink_pool.h"
#include "topology/machine.h"

namespace mars::host {
namespace {

CompiledFilm load(const RenderOptions& options) {
  CompileOptions compiling;
  if (options.intervals == Intervals::keyframes) compiling.cutting = Cutting::keyframes;
  if (options.size) compiling.size = {options.size->width, options.size->height};
  return load_film(options.film, compiling);
}

// Where the frames go: a folder with its sink, or nowhere.
class Destination {
 public:
  Destination(const RenderOptions& options, const CompiledFilm& film, const std::vector<std::uint32_t>& frames) {
    if (options.sink == SinkKind::none) {
      sink_ = std::make_unique<NothingSink>();
      return;
    }
    const node::FilmSettings& settings = film.view().settings();
    folder_.emplace(options.folder, Manifest{options.film, checksum_of(film.block()), settings.width, settings.height,
                                             settings.rate, settings.frames, frames});
    sink_ = std::make_unique<PngSink>(*folder_);
  }

  Sink& sink() { return *sink_; }

 private:
  std::optional<FrameFolder> folder_;
  std::unique_ptr<Sink> sink_;
};

// Sinks work while nodes wait for credit, so they may have every processor.
SinkPool::Shape pool_shape(const node::FilmSettings& settings, std::uint32_t block) {
  const auto threads = static_cast<std::uint32_t>(std::clamp(topology::Machine::here().processors(), 2, 16));
  return {settings.width, settings.height, block, threads + 2, threads};
}

BootedEvent booted_event(std::span<const node::Hello> hellos, const char* backend) {
  BootedEvent event;
  event.backend = backend;
  std::set<std::int32_t> machines;
  for (const node::Hello& hello : hellos) {
    machines.insert(hello.machine);
    event.nodes.push_back({hello.host.data(), hello.binding.data(), hello.simd.data()});
  }
  event.machines = static_cast<std::uint32_t>(machines.size());
  return event;
}

FarmListener tell_events(const char* backend) {
  FarmListener listener;
  listener.booted = [backend](std::span<const node::Hello> hellos, std::uint32_t keyframes, std::uint32_t inbetweens) {
    BootedEvent event = booted_event(hellos, backend);
    event.keyframes = keyframes;
    event.inbetweens = inbetweens;
    write_event(std::cout, event);
  };
  listener.finished = [](const FinishedFrame& frame) {
    write_event(std::cout, FrameEvent{frame.number, frame.interval, frame.kind == node::FrameKind::keyframe, frame.seconds});
  };
  return listener;
}

void render(const RenderOptions& options, const char* backend) {
  check_together(options);
  const CompiledFilm film = load(options);
  const node::FilmSettings& settings = film.view().settings();
  FarmOptions farm;
  farm.mapping = options.mapping;
  farm.coherence = !options.no_coherence;
  farm.cubes = options.cubes;
  farm.frames = options.frames.of_film(settings.frames);

  Destination destination(options, film, farm.frames);
  SinkPool pool(destination.sink(), pool_shape(settings, options.block));
  const FarmReport report = render_film(film.block(), farm, pool, tell_events(backend));
  if (!options.report.empty())
    write_report(options.report, {options.film, backend, settings.width, settings.height}, report);
  write_event(std::cout, DoneEvent{static_cast<std::uint32_t>(farm.frames.size()), report.total_seconds, options.folder});
}

// The command that shows the failure again, of one frame where it is known.
std::string replay_command(RenderOptions options, const char* backend, const Failure& failure) {
  const auto* at_node = dynamic_cast<const NodeFailure*>(&failure);
  if (at_node == nullptr) return "";
  if (at_node->frame >= 0) options.frames = FrameSet(std::to_string(at_node->frame));
  options.nodes = static_cast<std::uint32_t>(numnodes());
  options.backend = backend == std::string("mpi") ? Backend::mpi : Backend::threads;
  std::string command = "mars render";
  for (const std::string& argument : arguments_for(Program::mars, options)) command += " " + argument;
  return command;
}

}  // namespace

void run_render_job(const RenderOptions& options, const char* backend) {
  try {
    render(options, backend);
  } catch (const Failure& failure) {
    write_event(std::cout, FaultEvent{failure.problem, failure.where, failure.remedy, replay_command(options, backend, failure)});
    throw;
  } catch (const std::exception& failure) {
    write_event(std::cout, FaultEvent{failure.what(), "", "", ""});
    throw;
  }
}

}  // namespace mars::host
