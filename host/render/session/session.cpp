#include "host/render/session/session.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "host/content/document/checksum.h"
#include "host/content/document/whole_file.h"
#include "host/render/farm/farm.h"
#include "host/render/farm/host_memory.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/report/report.h"
#include "host/render/session/event_reporter.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/sink_pool.h"
#include "host/render/trace/trace_file.h"
#include "topology/machine.h"
#include "topology/memory_limit.h"

namespace mars::session {
namespace {

constexpr int kMostSinks = 64;
constexpr std::chrono::seconds kLongestEnd{10};  // of a run that fails, for what it has written

// Where the frames go: a folder with its sink, or nowhere.
class Destination {
 public:
  Destination(const RenderJob& job, const film::CompiledFilm& film, const std::vector<std::uint32_t>& frames,
              const sinks::Patience::Bounds& bounds) {
    if (job.folder.empty()) {
      sink_ = std::make_unique<sinks::NullSink>();
      return;
    }
    const wire::FilmSettings& settings = film.view().settings();
    folder_.emplace(job.folder,
                    sinks::Manifest{job.film,
                                    document::checksum_of(film.block()),
                                    settings.width,
                                    settings.height,
                                    job.format,
                                    settings.rate,
                                    settings.frames,
                                    frames,
                                    {}},
                    sinks::this_process(), bounds);
    sink_ = std::make_unique<sinks::FileSink>(*folder_);
  }

  sinks::Sink& sink() { return *sink_; }
  // Once it has taken all frames.
  void finish() {
    if (folder_) folder_->finish();
  }

 private:
  std::optional<sinks::FrameFolder> folder_;
  std::unique_ptr<sinks::Sink> sink_;
};

// What writes frames, and ends in this order: the threads, then the folder.
struct Output {
  std::optional<Destination> destination;
  std::unique_ptr<sinks::SinkPool> pool;
};

// On a thread of its own: where storage does not answer, that takes until it does, and nobody waits for it.
void end_output(std::unique_ptr<Output> output) try {
  const auto ended = std::make_shared<std::promise<void>>();
  std::thread([ended, output = std::move(output)]() mutable {
    output.reset();
    ended->set_value();
  }).detach();
  ended->get_future().wait_for(kLongestEnd);
} catch (const std::exception&) {  // no thread: it has ended already
}

sinks::Patience::Bounds bounds_of(const EventReporter& reporter) {
  return {.warn = [&reporter](const std::string& line) { reporter.report(events::Warning{line}); }};
}

farm::HostMemory memory_for(const HostMachine& host, const wire::FilmSettings& film, wire::PixelFormat format,
                            const farm::Plan& plan) {
  return farm::share_host_memory(host.memory, film, format, static_cast<std::uint32_t>(numnodes()),
                                 static_cast<std::uint32_t>(plan.groups.size()), sink_threads(host));
}

// New buffers show the first interval's background.
sinks::SinkPool::Shape pool_shape(const HostMachine& host, const wire::FilmView& film, const RenderJob& job,
                                  std::uint32_t frames) {
  const std::uint32_t threads = std::min(sink_threads(host), frames);
  const wire::PixelFormat format = images::facts_of(job.format).pixels;
  const std::uint64_t background = farm::background_pixel(film, film.intervals().front(), format);
  return {film.settings().width, film.settings().height, job.block, frames, threads, background, format};
}

std::unique_ptr<sinks::SinkPool> make_sinks(const RenderJob& job, sinks::Sink& sink,
                                            const sinks::SinkPool::Shape& shape) {
  return job.make_sinks ? job.make_sinks(sink, shape) : std::make_unique<sinks::SinkPool>(sink, shape);
}

farm::FarmOptions farm_options(const RenderJob& job, const farm::HostMemory& memory, trace::Trace* trace) {
  farm::FarmOptions farm;
  farm.mapping = job.mapping;
  farm.credits = memory.credits;
  farm.each_frame = !job.report.empty();
  farm.trace = trace;
  return farm;
}

// Fails early where the trace is not writable, not after the last frame.
std::unique_ptr<trace::Trace> begin_trace(const RenderJob& job) {
  if (job.trace.empty()) return nullptr;
  document::check_can_write(job.trace);
  return std::make_unique<trace::Trace>();
}

film::CompiledFilm load_film(const RenderJob& job, const EventReporter& reporter, double& seconds) {
  reporter.report(events::Loading{job.film});
  const double started = dclock();
  film::CompiledFilm film = job.load_film([&](const std::string& line) { reporter.report(events::Warning{line}); });
  seconds = dclock() - started;
  return film;
}

// By what is foreseen of it, unless the person says how many groups.
farm::Plan plan_of(const wire::FilmView& film, const RenderJob& job, EventReporter& reporter) {
  const auto nodes = static_cast<int>(numnodes());
  farm::PlanRequest request{job.frames.of_film(film.settings().frames), job.coherence, job.groups};
  if (job.foresee) {
    Foresight foresight = job.foresee(film, request, nodes);
    if (request.groups == 0) request.groups = foresight.groups;
    request.contributors = foresight.contributors;
    if (!foresight.warning.empty()) reporter.report(events::Warning{foresight.warning});
    reporter.expect(std::move(foresight.course));
  }
  return farm::make_plan(film, request, nodes);
}

void write_report(const RenderJob& job, const film::CompiledFilm& film, const farm::HostMemory& memory,
                  const farm::FarmReport& report) {
  const wire::FilmSettings& settings = film.view().settings();
  const report::ReportHead head{
      job.film, document::checksum_of(film.block()), job.backend, job.arguments, settings.width, settings.height,
      memory};
  document::write_whole_file(job.report, report::report_text(head, report));
}

void render(const RenderJob& job, EventReporter& reporter, trace::Trace* trace, Output& output) {
  double load_seconds = 0;
  const film::CompiledFilm film = load_film(job, reporter, load_seconds);
  const wire::FilmView view = film.view();
  const wire::FilmSettings& settings = view.settings();
  const farm::Plan plan = plan_of(view, job, reporter);
  const HostMachine host = host_machine(job.host);
  const farm::HostMemory memory = memory_for(host, settings, images::facts_of(job.format).pixels, plan);

  if (!job.report.empty()) document::check_can_write(job.report);  // early too
  output.destination.emplace(job, film, job.frames.of_film(settings.frames), bounds_of(reporter));
  // Only now: before, the host may have waited for its turn in the folder, and not for nodes.
  reporter.report(events::Loaded{load_seconds});
  output.pool = make_sinks(job, output.destination->sink(), pool_shape(host, view, job, memory.frames));
  const farm::FarmReport report = farm::render_film(film.block(), plan, farm_options(job, memory, trace), *output.pool,
                                                    reporter.listener(view.intervals().size()));
  output.destination->finish();
  const auto write = [&](const std::string& file, const std::function<void()>& whole) {
    sinks::Patience(bounds_of(reporter)).write(file, whole);
  };
  if (!job.report.empty()) write(job.report, [&] { write_report(job, film, memory, report); });
  if (trace) write(job.trace, [&] { trace::write_trace(job.trace, {job.film, job.backend}, *trace); });
  reporter.report(events::Done{plan.frames(), report.total_seconds, job.folder, trace ? trace->left_out() : 0});
}

// Why the run ends; of a node's failure also the command that shows it again, with one frame where it is known.
events::Fault fault_of(const std::exception& reason, const RenderJob& job) {
  const Failure failure = explain(reason);
  events::Fault fault{failure.problem, failure.where, failure.remedy, {}, {}, ""};
  const auto* at_node = dynamic_cast<const farm::NodeFailure*>(&reason);
  if (at_node == nullptr) return fault;
  fault.node = at_node->node;
  if (at_node->frame >= 0) fault.frame = at_node->frame;
  fault.replay = job.replay(static_cast<std::uint32_t>(numnodes()), fault.frame);
  return fault;
}

// What was traced until a run failed. Where that cannot be written, the run's own failure stays the one that is thrown.
void write_failed_trace(const std::string& reason, const RenderJob& job, const EventReporter& reporter,
                        trace::Trace& trace) {
  trace.fail(reason, dclock());
  try {
    trace::write_trace(job.trace, {job.film, job.backend}, trace);
  } catch (const std::exception& failure) {
    reporter.report(events::Warning{reason_of(failure)});
  }
}

}  // namespace

HostMachine host_machine(HostMachine asked) {
  const topology::Machine here = topology::Machine::here();
  if (asked.memory == 0) asked.memory = topology::memory_share(here.memory(), topology::memory_limit(), 1);
  if (asked.processors == 0) asked.processors = here.processors();
  return asked;
}

std::uint32_t sink_threads(const HostMachine& host) {
  return static_cast<std::uint32_t>(std::clamp(host.processors, 2, kMostSinks));
}

void run_session(const RenderJob& job) {
  EventReporter reporter(job.backend);
  std::unique_ptr<trace::Trace> trace;
  auto output = std::make_unique<Output>();
  try {
    trace = begin_trace(job);
    render(job, reporter, trace.get(), *output);
  } catch (const std::exception& reason) {
    reporter.report(fault_of(reason, job));
    if (trace && trace->begun()) write_failed_trace(reason_of(reason), job, reporter, *trace);
    end_output(std::move(output));
    throw;
  }
}

}  // namespace mars::session
