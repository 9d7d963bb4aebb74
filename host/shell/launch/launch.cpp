#include "host/shell/launch/launch.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iostream>
#include <memory>
#include <thread>

#include "hal/messages/settings.h"
#include "host/child/child.h"
#include "host/child/descriptor.h"
#include "host/child/environment.h"
#include "host/child/process.h"
#include "host/child/signal_relay.h"
#include "host/child/standard_streams.h"
#include "host/render/events/events.h"
#include "host/render/resume/resume.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/verify.h"
#include "host/content/document/text.h"
#include "host/shell/launch/between_jobs.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/display.h"
#include "host/shell/launch/film_check.h"
#include "host/shell/launch/film_panorama.h"
#include "host/shell/launch/film_videos.h"
#include "host/shell/launch/job.h"
#include "host/shell/launch/rendering_window.h"
#include "host/shell/launch/shown_job.h"
#include "host/shell/launch/starting.h"
#include "host/shell/launch/supervisor.h"

namespace mars::launch {

namespace {

constexpr std::chrono::seconds kLongestTrial{30};
constexpr std::chrono::milliseconds kLongestClearing{2500};  // after a run that failed
constexpr std::chrono::milliseconds kClearingLook{5};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// By a process of its own: where storage does not answer, this one ends nevertheless. How many frames the run `ended`
// has rendered; 0: that is not known.
std::uint32_t clear_ended_runs(const std::string& folder, const std::string& ended = "") {
  const child::Descriptor nothing = child::null_device(), answer = child::file_in_memory();
  const auto work = [&] {
    const std::uint32_t frames = sinks::clear_ended_runs(folder, ended);
    return pwrite(answer.number(), &frames, sizeof frames, 0) == sizeof frames ? 0 : 1;
  };
  child::Process clears(work, {.streams = {{1, nothing.number()}, {2, nothing.number()}}});
  const auto last = std::chrono::steady_clock::now() + kLongestClearing;
  while (!clears.poll() && std::chrono::steady_clock::now() < last) std::this_thread::sleep_for(kClearingLook);
  std::uint32_t frames = 0;
  return pread(answer.number(), &frames, sizeof frames, 0) == sizeof frames ? frames : 0;
}

// Slurm ends the processes on the other machines first: what began again on this one would only keep the other job
// waiting.
void fail_if_preempted(const options::RenderOptions& options, const Starting& starting) {
  if (is_preempted(starting.surroundings.environment, starting.path))
    throw Failure("Slurm takes the machines for another job", options.folder,
                  "the same command goes on with the missing frames");
}

std::optional<std::uint32_t> count_there(const std::string& folder, const std::vector<std::uint32_t>& frames) try {
  return frames.size() - sinks::missing_frames(folder, sinks::read_manifest(folder), frames).size();
} catch (const Failure&) {
  return std::nullopt;
}

Supervisor::World world_of(const options::RenderOptions& options, const Starting& starting, Display& display,
                           const Adviser& adviser) {
  return {[&](const options::RenderOptions& job, const std::vector<Slots>& machines) {
            return show_job(job, starting, machines, display, adviser);
          },
          [&](const std::string& run) { return options.folder.empty() ? 0 : clear_ended_runs(options.folder, run); },
          [&] { return machines_of(options, starting); },
          [&](std::chrono::seconds pause, const std::vector<std::string>& machines) {
            const Question question = question_of(options, starting);
            const std::set<std::string> answering = wait_and_ask({pause, question, machines}, starting.path);
            if (question == Question::slurm) fail_if_preempted(options, starting);
            return answering;
          },
          [&](const std::vector<std::uint32_t>& frames) { return count_there(options.folder, frames); },
          [&](const std::string& line) { display.print(line); },
          [&] { return adviser.after_a_failed_start(options); }};
}

// The account is of all jobs together, where there were several or the only one died after its last frame.
std::string account_of(const Supervisor& supervisor, const std::string& folder, double seconds) {
  const std::string& machine = supervisor.last().elsewhere;
  const std::string where = machine.empty() ? "" : "; " + elsewhere_text(folder, machine);
  if (supervisor.restarts() == 0 && supervisor.last().done) return done_text(*supervisor.last().done) + where;
  return document::counted(supervisor.frames().there(), "frame") + " in " + folder + ", " +
         document::formatted("%.1f", seconds) + " seconds, with " +
         document::counted(supervisor.restarts(), "restart") + where;
}

// The number of frames, where nothing is left to render; of a measurement the host says so.
std::optional<std::uint32_t> frames_there(const options::RenderOptions& options) {
  if (options.sink == options::SinkKind::none || options::measures(options)) return std::nullopt;
  return resume::count_if_complete({options.folder, options.film, options::film_arguments(options),
                                    options::form_of(options), options.frames, options.overwrite, options.kept_film});
}

// The host, which sends frames to a window, runs where the first process of a job runs.
void expect_host_here(const options::RenderOptions& options, const Starting& starting) {
  const std::vector<Slots> machines = machines_of(options, starting);
  if (machines.empty() || is_here(machines.front().host)) return;
  throw Failure("the host would run on " + machines.front().host + ", and a window is on this machine alone", "",
                "name this machine first, or leave out --window");
}

// From now on hosts send frames to the window; none without --window.
std::unique_ptr<RenderingWindow> open_window(options::RenderOptions& options, const Starting& starting,
                                             const std::filesystem::path& self) {
  if (!options.window) return nullptr;
  expect_host_here(options, starting);
  auto window = std::make_unique<RenderingWindow>(self, options.film);
  options.watch = window->socket();
  return window;
}

// A signal between two jobs, or after the last, ends the rendering as one during a job does.
void supervise(Supervisor& supervisor, const options::RenderOptions& options) {
  const child::SignalRelay signals;
  supervisor.render();
  if (signals.first() != 0)
    throw Failure("stopped by " + std::string(strsignal(signals.first())), options.folder, way_to_go_on(options));
}

// Renders what nodes draw of the film: frames of the folder, or faces.
void render(options::RenderOptions options, const std::filesystem::path& self, const Adviser& adviser,
            Display& display) {
  const auto started = std::chrono::steady_clock::now();
  const Starting starting = prepare(options, self);
  const std::unique_ptr<RenderingWindow> window = open_window(options, starting, self);
  Supervisor supervisor(options, world_of(options, starting, display, adviser));
  supervise(supervisor, options);
  if (window) window->leave();
  if (!supervisor.last().ended_for.empty())
    std::cerr << "mars: warning: all frames are there, but " << supervisor.last().ended_for << '\n';
  if (supervisor.restarts() > 0 && !(options.report + options.trace).empty())
    std::cerr << "mars: warning: the report and the trace are of the last job alone\n";
  if (supervisor.rendered()) display.print(account_of(supervisor, options.folder, seconds_since(started)));
}

// Frames that a killed process has torn in a working folder are drawn again: nobody could repair it. False where all
// frames there are whole, or none can be removed, as while another run draws into the folder.
bool remove_damaged_frames(const std::string& folder, Display& display) try {
  const sinks::Verdict verdict = sinks::verify_folder(folder);
  if (verdict.troubles.empty()) return false;
  sinks::remove_wrong_files(folder, verdict);
  display.print(document::counted(verdict.troubles.size(), "damaged or missing frame") + " of " + folder +
                ": drawn again");
  return true;
} catch (const Failure&) {
  return false;
}

// `draw` puts frames into a working folder, `use` makes something of them.
void draw_and_use(options::RenderOptions drawn, const std::function<void(const options::RenderOptions&)>& draw,
                  const std::function<void()>& use, Display& display) {
  draw(drawn);
  try {
    return use();
  } catch (const sinks::DamagedFrame&) {
    if (!remove_damaged_frames(drawn.folder, display)) throw;
  }
  drawn.overwrite = false;
  if (options::measures(drawn)) display.print("the report and the trace have nothing of what is drawn again");
  drawn.report = drawn.trace = "";
  draw(drawn);
  use();
}

// Where no frames are written, faces are drawn and not joined.
void render_panorama(const options::RenderOptions& options, const std::filesystem::path& self, const Adviser& adviser,
                     Display& display) {
  if (options.sink == options::SinkKind::none) return render(faces_of(options), self, adviser, display);
  FilmPanorama panorama(options, display);
  if (panorama.is_there()) return remove_left_faces(options.folder);
  const auto draw = [&](const options::RenderOptions& faces) {
    if (!frames_there(faces)) render(faces, self, adviser, display);
  };
  draw_and_use(
      panorama.faces(), draw, [&] { panorama.join(); }, display);
}

// Draws those frames of the folder that are not there yet.
void render_frames(const options::RenderOptions& options, const std::filesystem::path& self, const Adviser& adviser,
                   Display& display) {
  if (const auto there = frames_there(options)) {
    clear_ended_runs(options.folder);
    remove_left_faces(options.folder);
    return display.print(resumed_text({*there, *there, ""}));
  }
  if (!options.kept_film) check_film_file(options.film);  // else it may be gone
  if (is_panorama(options))
    render_panorama(options, self, adviser, display);
  else
    render(options, self, adviser, display);
}

}  // namespace

void launch_render(options::RenderOptions options, const std::filesystem::path& self, const Adviser& adviser) {
  Display display(kind_of_output(options.quiet), child::raw_output());
  for (const std::string& line : messages::unknown_settings()) display.print(line);
  messages::read_settings();  // wrong settings fail before anything is started
  FilmVideos videos(options, display);
  if (videos.are_there()) return;
  const auto draw = [&](const options::RenderOptions& frames) { render_frames(frames, self, adviser, display); };
  const auto make = [&] { videos.make(); };
  if (options.own_folder) return draw_and_use(options, draw, make, display);
  draw(options);
  make();
}

Trial try_start(options::RenderOptions options, const std::filesystem::path& self) {
  options.film = options::kTrialFilm;
  options.sink = options::SinkKind::none;
  messages::read_settings();
  const Starting starting = prepare(options, self);
  const child::Command command = command_for(options, starting);
  Display nothing(Display::Kind::silent, child::raw_output());
  Job job(nothing);
  bool given_up = false;
  job.follow(command, {kLongestTrial,
                       [&](child::Child& child) {
                         given_up = true;
                         child.stop();
                       },
                       [] {}});
  if (job.remains().passed_on != 0) throw stopped(job.remains(), options);
  Trial trial{shell_text(command), job.boot_seconds(), {}, 0, std::nullopt};
  if (const auto& booted = job.remains().booted) trial.booted = *booted;
  if (job.remains().well()) {
    trial.frames = job.remains().done->frames;
  } else if (given_up) {
    trial.failure = Failure("no node has answered for " + std::to_string(kLongestTrial.count()) + " seconds", "",
                            "see whether the machines reach each other, and what the line below says by itself");
  } else {
    trial.failure = diagnose(job.remains(), options, [] { return std::string(); }).failure;
  }
  return trial;
}

}  // namespace mars::launch
