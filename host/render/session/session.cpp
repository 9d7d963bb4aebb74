#include "host/render/session/session.h"

#include <limits.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <thread>
#include <utility>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "host/content/document/file_failure.h"
#include "host/content/document/recorded_reads.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/excerpt.h"
#include "host/content/film/frame_content.h"
#include "host/render/farm/assembly.h"
#include "host/render/farm/farm.h"
#include "host/render/farm/host_memory.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/report/report.h"
#include "host/render/resume/resume.h"
#include "host/render/session/event_reporter.h"
#include "host/render/session/heartbeat_listener.h"
#include "host/render/session/status_board.h"
#include "host/render/session/termination.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/restore.h"
#include "host/render/sinks/sink_pool.h"
#include "host/render/trace/trace_file.h"
#include "topology/machine.h"
#include "topology/memory_limit.h"

namespace mars::session {
namespace {

constexpr int kMostSinks = 64;
constexpr std::chrono::seconds kLongestEnd{10};  // of a run that fails, for what it has written

sinks::FrameEncoder::Encode encoding_of(const RenderJob& job, const wire::PackedFilm& film) {
  if (!job.view) return sinks::encode_band;
  const sinks::LightShown shown{job.view, [film](std::uint32_t frame) { return film.camera_at(frame).exposure; }};
  return [shown](const images::PictureBands& bands, compositor::Frame& frame, std::size_t band) {
    return sinks::encode_light(shown, bands, frame, band);
  };
}

// To nowhere where there is no folder.
std::unique_ptr<sinks::Sink> make_sink(const RenderJob& job, sinks::FrameFolder* folder, const wire::PackedFilm& film) {
  if (folder == nullptr) return std::make_unique<sinks::NullSink>();
  const auto content = std::make_shared<film::FrameContent>(film, job.form.layers);
  return std::make_unique<sinks::FileSink>(
      *folder, [content](std::uint32_t frame) { return content->checksum(frame); }, encoding_of(job, film), &film);
}

// What writes frames, and ends in this order: the threads, then the folder, then what it shows.
struct Output {
  explicit Output(const std::string& film) : board(film) {}

  StatusBoard board;
  film::CompiledFilm film;                     // what its frames are of
  std::optional<film::CompiledFilm> excerpt;   // of that, what they show; none: all of it
  std::unique_ptr<sinks::FrameFolder> folder;  // none: frames go nowhere
  std::unique_ptr<sinks::Sink> sink;
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

// Before anything is drawn; nodes, which draw a picture in parts, have enough where the host has.
void check_pictures(const farm::HostMemory& memory, const std::string& film) {
  const std::uint32_t kept = memory.backgrounds;  // buffers, and each group's saved background
  const std::uint64_t needed = kept * memory.frame_bytes, here = topology::usable_memory();
  if (needed <= here) return;
  using topology::gigabytes;
  throw Failure("has pictures of " + gigabytes(memory.frame_bytes) + ", of which the host keeps " +
                    std::to_string(kept) + ": it needs " + gigabytes(needed) + " of memory, where there are " +
                    gigabytes(here),
                film,
                "render a smaller picture (--size), or parts of it by themselves (--crop), or fewer layers (--layers)"
                " or groups (--groups)");
}

// What nodes draw: what files hold, or the light that a view shows in them.
wire::PixelFormat drawn_pixels(const RenderJob& job, const wire::FilmSettings& film) {
  using wire::PixelFormat;
  const PixelFormat pixels = images::pixels_of(job.form.format, job.form.layers, film.samples);
  if (!job.view) return pixels;
  return wire::has_alpha(pixels) ? PixelFormat::half_alpha : PixelFormat::half;
}

void refuse_colors_without_light(const RenderJob& job, const wire::FilmSettings& settings) {
  if (job.view && settings.color_space == wire::ColorSpace::coded)
    throw Failure("has coded colours, which no view shows", job.film,
                  "make its \"color\" \"linear\", or leave out --ocio");
}

// New buffers show the first interval's background.
sinks::SinkPool::Shape pool_shape(const HostMachine& host, const wire::PackedFilm& film, const RenderJob& job,
                                  std::uint32_t frames) {
  const std::uint32_t threads = std::min(sink_threads(host), frames);
  const wire::PixelFormat format = drawn_pixels(job, film.settings());
  const std::uint64_t background = farm::background_pixel(film, film.intervals().front(), format);
  return {film.settings().width, film.settings().height, job.block, frames, threads, background, format};
}

std::unique_ptr<sinks::SinkPool> make_sinks(const RenderJob& job, sinks::Sink& sink,
                                            const sinks::SinkPool::Shape& shape) {
  return job.make_sinks ? job.make_sinks(sink, shape) : std::make_unique<sinks::SinkPool>(sink, shape);
}

farm::FarmOptions farm_options(const RenderJob& job, const farm::HostMemory& memory, trace::Trace* trace,
                               farm::Heartbeats& heartbeats, watch::Watch* watch) {
  farm::FarmOptions farm;
  farm.mapping = job.mapping;
  farm.exchange = job.exchange;
  farm.credits = memory.credits;
  farm.each_frame = !job.report.empty();
  farm.adapts = job.adapts;
  farm.trace = trace;
  farm.heartbeats = &heartbeats;
  farm.watch = watch;
  return farm;
}

// On one machine the host writes as soon, with processors that nodes do not use.
bool nodes_write_sooner(const Prediction& prediction, std::span<const wire::Hello> nodes) {
  std::map<std::int32_t, int> machines;
  for (const wire::Hello& node : nodes) ++machines[node.machine];
  if (machines.size() < 2 || !prediction.nodes_write_sooner) return false;
  return prediction.nodes_write_sooner(std::ranges::max(std::views::values(machines)));
}

// Nodes hear that the host lives also while it waits for storage.
void record(const wire::Written& written, sinks::FrameFolder& folder, farm::Heartbeats& heartbeats) {
  const std::string hash = written.pixel_hash.data();
  folder.note_used({.bytes = written.bytes});
  try {
    folder.note_written(written.frame, hash);
  } catch (const document::FileFailure&) {
    heartbeats.during("waiting for storage", [&] { folder.wait_to_note_written(written.frame, hash); });
  }
}

// The orders of nodes that write frames' files, and what the folder records of the files.
farm::Writing make_writing(const sinks::WriterOrders& orders, sinks::FrameFolder& folder,
                           farm::Heartbeats& heartbeats) {
  return {sinks::bytes_of(orders),
          {},
          [&folder](const wire::Hello& first) { return folder.sees_probe_of(first.node); },
          [&folder, &heartbeats](const wire::Written& written) { record(written, folder, heartbeats); }};
}

// None: the host writes. Of a run that is watched it needs the pixels.
std::optional<farm::Writing> writing_of(const RenderJob& job, const Prediction& prediction, sinks::FrameFolder* folder,
                                        farm::Heartbeats& heartbeats) {
  if (folder == nullptr || job.writers == Writers::host || !job.watch.empty() || job.view) return job.writing;
  const sinks::WriterOrders orders = folder->writer_orders();
  const bool is_short = orders.part_of(0).native().size() < PATH_MAX;
  farm::Writing writing = make_writing(orders, *folder, heartbeats);
  if (job.writers == Writers::nodes) {
    if (!is_short)
      throw Failure("its whole path is too long for nodes", folder->path().string(), "shorten it, or use --write host");
    folder->add_probe();
    return writing;
  }
  if (!is_short) return std::nullopt;
  writing.is_wanted = [&prediction, folder, &heartbeats](std::span<const wire::Hello> nodes) {
    bool wanted = false;
    heartbeats.during("loading", [&] { wanted = nodes_write_sooner(prediction, nodes); });
    if (wanted) folder->add_probe();
    return wanted;
  };
  return writing;
}

// A node that cannot write because the run has lost its folder has not died of anything that a new start would mend.
farm::FarmReport render_frames(const film::CompiledFilm& film, const farm::Plan& plan, const farm::FarmOptions& options,
                               const Output& output, const farm::FarmListener& listener) {
  try {
    return farm::render_film(film.block(), plan, options, *output.pool, listener);
  } catch (const farm::NodeFailure&) {
    if (options.writing != nullptr) output.folder->confirm_claim();
    throw;
  }
}

// What takes the place of the film or of what the folder keeps would destroy it.
void refuse_outputs(const RenderJob& job) {
  namespace fs = std::filesystem;
  std::error_code none;
  sinks::Manifest names;
  sinks::set_form(names, job.form);
  names.film_frames = wire::kMostFrames;  // the film's are not known yet
  for (const fs::path output : {job.report, job.trace}) {
    document::refuse_same_file(job.film, output);
    const fs::path folder = output.has_parent_path() ? output.parent_path() : ".";
    const std::string name = output.filename().string();
    const bool own = sinks::is_own_name(name) || sinks::frame_of_file(names, name);
    if ((own && fs::equivalent(folder, job.folder, none)) ||
        fs::equivalent(folder, fs::path(job.folder) / sinks::kRunsName, none))
      throw Failure("is the name of a file that the folder of frames keeps", output.string(), "name it otherwise");
  }
}

// Its models, too.
void refuse_outputs_among(const document::RecordedReads& reads, const RenderJob& job) {
  for (const std::string& output : {job.report, job.trace}) reads.refuse_output(output);
}

// Fails early where the trace is not writable, not after the last frame.
std::unique_ptr<trace::Trace> begin_trace(const RenderJob& job) {
  if (job.trace.empty()) return nullptr;
  document::check_can_write(job.trace);
  return std::make_unique<trace::Trace>();
}

std::unique_ptr<watch::Watch> begin_watch(const RenderJob& job, const EventReporter& reporter) {
  if (job.watch.empty()) return nullptr;
  auto watch = std::make_unique<watch::Watch>(job.watch);
  if (!watch->absent().empty())
    reporter.report(events::Warning{"nobody watches yet at " + job.watch + ": " + watch->absent()});
  return watch;
}

// The film, and which of its frames are to be rendered.
resume::Opened open_film(const RenderJob& job, const EventReporter& reporter) {
  const sinks::Patience::Bounds bounds = bounds_of(reporter);
  const auto compile = [&] {
    const document::RecordedReads reads;
    film::CompiledFilm film = job.load_film(bounds.warn);
    refuse_outputs_among(reads, job);
    return film;
  };
  if (!job.folder.empty())
    return resume::open({job.folder, job.film, job.film_options, job.form, job.frames, job.overwrite, job.kept_film},
                        compile, bounds);
  film::CompiledFilm film = compile();
  std::vector<std::uint32_t> frames = job.frames.of_film(film.view().settings().frames);
  const auto asked = static_cast<std::uint32_t>(frames.size());
  return {std::move(film), nullptr, asked, std::move(frames), ""};
}

resume::Opened load_film(const RenderJob& job, const EventReporter& reporter, farm::Heartbeats& heartbeats) {
  reporter.report(events::Loading{job.film});
  const double started = dclock();
  std::optional<resume::Opened> opened;
  heartbeats.during("loading", [&] {
    const document::RecordedReads reads;
    opened.emplace(open_film(job, reporter));
    refuse_outputs_among(reads, job);
  });
  const auto left = static_cast<std::uint32_t>(opened->frames.size());
  if (left < opened->asked || !opened->changed.empty())
    reporter.report(events::Resumed{opened->asked - left, opened->asked, opened->changed});
  // Only now: before, the host may have waited for its turn in the folder, and not for nodes.
  reporter.report(events::Loaded{dclock() - started, opened->folder ? opened->folder->run() : ""});
  return std::move(*opened);
}

struct Planned {
  farm::Plan plan;
  Prediction prediction;
};

// By what is predicted of it, as far as the person does not say.
Planned plan_of(const wire::PackedFilm& film, const std::vector<std::uint32_t>& frames, const RenderJob& job,
                EventReporter& reporter, farm::Heartbeats& heartbeats) {
  const auto nodes = static_cast<int>(numnodes());
  farm::PlanRequest request{frames, job.coherence, job.groups, 0, job.sharers, job.most_frames};
  Prediction prediction;
  if (job.predict) {
    heartbeats.during("loading", [&] { prediction = job.predict(film, request, nodes); });
    if (request.groups == 0) request.groups = prediction.groups;
    request.contributors = prediction.contributors;
    if (request.sharers == 0) request.sharers = prediction.sharers;
    if (request.most_frames == 0) request.most_frames = prediction.most_frames;
    if (!prediction.warning.empty()) reporter.report(events::Warning{prediction.warning});
    reporter.expect(std::exchange(prediction.course, {}));
  }
  return {farm::make_plan(film, request, nodes), std::move(prediction)};
}

// A measurement of nothing would pass as one of the film.
void render_nothing(const RenderJob& job, const EventReporter& reporter) {
  for (const std::string& file : {job.report, job.trace})
    if (!file.empty())
      reporter.report(events::Warning{"nothing is left to render, so " + file +
                                      " is not written (--overwrite renders all again, --sink none only measures)"});
  farm::dismiss_nodes();
  reporter.report(events::Done{0, 0, job.folder});
}

void write_report(const RenderJob& job, const film::CompiledFilm& film, const farm::HostMemory& shared,
                  const farm::FarmReport& report, const sinks::Usage& usage) {
  const farm::HostMemory memory = report.node_files == report.frames.size() ? farm::where_nodes_write(shared) : shared;
  const wire::FilmSettings& settings = film.view().settings();
  const report::ReportHead head{job.film,       film.checksum(), job.backend, job.arguments,
                                settings.width, settings.height, memory,      usage};
  document::write_whole_file(job.report, report::report_text(head, report));
}

void render(const RenderJob& job, EventReporter& reporter, trace::Trace* trace, Output& output) {
  refuse_outputs(job);
  if (!job.report.empty()) document::check_can_write(job.report);  // early too
  Termination termination(messages::process().backend().has_machine_clock());
  farm::Heartbeats heartbeats(host_name(), getpid(), heartbeat_listener(reporter, termination));
  resume::Opened opened = load_film(job, reporter, heartbeats);
  if (opened.frames.empty()) return render_nothing(job, reporter);
  output.film = std::move(opened.film);
  const film::CompiledFilm& film = output.film;
  heartbeats.during("loading", [&] { output.excerpt = film::excerpt_of(film, opened.frames); });
  const film::CompiledFilm& drawn = output.excerpt ? *output.excerpt : film;
  const wire::PackedFilm view = drawn.view();
  const wire::FilmSettings& settings = view.settings();
  refuse_colors_without_light(job, settings);
  const auto [plan, prediction] = plan_of(view, opened.frames, job, reporter, heartbeats);
  const HostMachine host = host_machine(job.host);
  const farm::HostMemory memory = memory_for(host, settings, drawn_pixels(job, settings), plan);
  check_pictures(memory, job.film);

  output.folder = std::move(opened.folder);
  if (output.folder) output.folder->show_status([&board = output.board] { return board.status(); });
  output.sink = make_sink(job, output.folder.get(), view);
  output.pool = make_sinks(job, *output.sink, pool_shape(host, view, job, memory.frames));
  const auto watch = begin_watch(job, reporter);
  const std::optional<farm::Writing> writing = writing_of(job, prediction, output.folder.get(), heartbeats);
  farm::FarmOptions options = farm_options(job, memory, trace, heartbeats, watch.get());
  options.writing = writing ? &*writing : nullptr;
  const farm::FarmReport report =
      render_frames(drawn, plan, options, output, reporter.listener(view.intervals().size()));
  const auto write = [&](const std::string& file, const std::function<void()>& whole) {
    sinks::Patience(bounds_of(reporter)).write(file, whole);
  };
  heartbeats.during("ending", [&] {
    if (output.folder) output.folder->finish(&film);
    const sinks::Usage usage = output.folder ? output.folder->whole_usage() : output.board.status().used;
    if (!job.report.empty()) write(job.report, [&] { write_report(job, film, memory, report, usage); });
    if (trace) write(job.trace, [&] { trace::write_trace(job.trace, {job.film, job.backend}, *trace); });
  });
  reporter.report(events::Done{plan.frames(), report.total_seconds, job.folder, trace ? trace->left_out() : 0});
}

// Why the run ends; of a node's failure also the command that shows it again, with one frame where it is known.
events::Fault fault_of(const std::exception& reason, const RenderJob& job) {
  events::Fault fault = session::fault_of(reason);
  if (const auto* gone = dynamic_cast<const sinks::LostFrames*>(&reason)) fault.lost = gone->frames;
  const auto* at_node = dynamic_cast<const farm::NodeFailure*>(&reason);
  if (at_node == nullptr) return fault;
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
  auto output = std::make_unique<Output>(job.film);
  EventReporter reporter(job.backend, output->board);
  std::unique_ptr<trace::Trace> trace;
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
