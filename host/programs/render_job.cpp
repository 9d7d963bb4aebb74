#include "host/programs/render_job.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "host/render/events/events.h"
#include "host/render/farm/farm.h"
#include "host/programs/film_of.h"
#include "host/render/report/report.h"
#include "host/content/document/checksum.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/sink_pool.h"
#include "host/content/document/whole_file.h"
#include "host/render/trace/trace_file.h"
#include "topology/machine.h"

namespace mars::host {
namespace {

// Where the frames go: a folder with its sink, or nowhere.
class Destination {
 public:
  Destination(const RenderOptions& options, const CompiledFilm& film,
              const std::vector<std::uint32_t>& frames) {
    if (options.sink == SinkKind::none) {
      sink_ = std::make_unique<NothingSink>();
      return;
    }
    const node::FilmSettings& settings = film.view().settings();
    folder_.emplace(options.folder, Manifest{options.film, checksum_of(film.block()), settings.width,
                                             settings.height, settings.rate, settings.frames, frames, {}});
    sink_ = std::make_unique<PngSink>(*folder_);
  }

  Sink& sink() { return *sink_; }
  // Once it has taken all frames.
  void finish() {
    if (folder_) folder_->finish();
  }

 private:
  std::optional<FrameFolder> folder_;
  std::unique_ptr<Sink> sink_;
};

// Sinks work while nodes wait for credit, so they may have every processor; but large pictures wait for each
// other rather than fill the machine's memory.
SinkPool::Shape pool_shape(const node::FilmSettings& settings, std::uint32_t block) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
  const std::uint64_t frame_bytes = std::uint64_t{settings.width} * settings.height * sizeof(std::uint32_t);
  const auto processors = static_cast<std::uint64_t>(topology::Machine::here().processors());
  const std::uint64_t threads = std::clamp<std::uint64_t>(processors, 2, 16);
  const std::uint64_t frames = std::clamp<std::uint64_t>(kMostBytes / frame_bytes, 2, threads + 2);
  return {settings.width, settings.height, block, static_cast<std::uint32_t>(frames),
          static_cast<std::uint32_t>(std::min(threads, frames)), pixel_of(settings.background)};
}

Booted booted_event(std::span<const node::Hello> hellos, const char* backend) {
  Booted event;
  event.backend = backend;
  std::set<std::int32_t> machines;
  for (const node::Hello& hello : hellos) {
    machines.insert(hello.machine);
    event.nodes.push_back({hello.node, hello.host.data(), hello.rank, hello.binding.data(), hello.simd.data()});
  }
  event.machines = static_cast<std::uint32_t>(machines.size());
  return event;
}

void tell(const Event& event) { std::cout << line_of(event) << std::flush; }

// Tells the farm's news on standard output, and how far it is.
class Teller {
 public:
  Teller(const char* backend, std::size_t intervals) : backend_(backend) {
    progress_.intervals = static_cast<std::uint32_t>(intervals);
  }

  FarmListener listener() {
    FarmListener listener;
    listener.booted = [this](std::span<const node::Hello> hellos, std::uint32_t keyframes,
                             std::uint32_t inbetweens) {
      progress_.keyframes.of = keyframes;
      progress_.inbetweens.of = inbetweens;
      tell(booted_event(hellos, backend_));
      tell(progress_);
    };
    listener.finished = [this](const FinishedFrame& frame) {
      tell(FrameTaken{frame.number, frame.interval, frame.kind});
      progress_.count(frame.kind, frame.interval, frame.seconds);
      tell(progress_);
    };
    return listener;
  }

 private:
  const char* backend_;
  Progress progress_;
};

// Throws as a trace could not be written, better now than after the last frame.
std::unique_ptr<Trace> begin_trace(const RenderOptions& options) {
  if (options.trace.empty()) return nullptr;
  check_can_write(options.trace);
  return std::make_unique<Trace>();
}

void render(const RenderOptions& options, const char* backend, Trace* trace) {
  tell(Loading{options.film});
  const double started = dclock();
  const CompiledFilm film = load_film_of(options, [](const std::string& line) { tell(Warning{line}); });
  const double load_seconds = dclock() - started;
  const node::FilmSettings& settings = film.view().settings();
  FarmOptions farm;
  farm.mapping = options.mapping;
  farm.coherence = !options.no_coherence;
  farm.groups = options.groups;
  farm.each_frame = !options.report.empty();
  farm.frames = options.frames.of_film(settings.frames);
  farm.trace = trace;

  // Better now than after the last frame.
  if (!options.report.empty()) check_can_write(options.report);
  Destination destination(options, film, farm.frames);
  tell(Loaded{load_seconds});  // only now: nobody waits for nodes while the host waits for its turn in the folder
  SinkPool pool(destination.sink(), pool_shape(settings, options.block));
  Teller teller(backend, film.view().intervals().size());
  const FarmReport report = render_film(film.block(), farm, pool, teller.listener());
  destination.finish();
  if (!options.report.empty()) {
    const ReportHead head{options.film,   checksum_of(film.block()),
                          backend,        arguments_for(Program::host, options),
                          settings.width, settings.height};
    write_whole_file(options.report, report_text(head, report));
  }
  if (trace) write_trace(options.trace, {options.film, backend}, *trace);
  tell(Done{static_cast<std::uint32_t>(farm.frames.size()), report.total_seconds, options.folder,
            trace ? trace->left_out() : 0});
}

// Why the run ends; of a node's failure also the command that shows it again, with one frame where it is
// known.
Fault fault_of(const std::exception& reason, RenderOptions options, const char* backend) {
  const Failure failure = explain(reason);
  Fault fault{failure.problem, failure.where, failure.remedy, {}, {}, ""};
  const auto* at_node = dynamic_cast<const NodeFailure*>(&reason);
  if (at_node == nullptr) return fault;
  fault.node = at_node->node;
  if (at_node->frame >= 0) fault.frame = at_node->frame;
  if (at_node->frame >= 0) options.frames = FrameSet(std::to_string(at_node->frame));
  options.nodes = static_cast<std::uint32_t>(numnodes());
  options.backend = backend == std::string("mpi") ? Backend::mpi : Backend::threads;
  fault.replay = "mars render";
  for (const std::string& argument : arguments_for(Program::mars, options)) fault.replay += " " + argument;
  return fault;
}

}  // namespace

void run_render_job(const RenderOptions& options, const char* backend) {
  std::unique_ptr<Trace> trace;
  try {
    trace = begin_trace(options);
    render(options, backend, trace.get());
  } catch (const std::exception& reason) {
    tell(fault_of(reason, options, backend));
    if (trace && trace->begun()) {
      trace->fail(reason_of(reason), dclock());
      write_trace(options.trace, {options.film, backend}, *trace);
    }
    throw;
  }
}

}  // namespace mars::host
