#include "host/shell/launch/launch.h"

#include <algorithm>
#include <chrono>
#include <iostream>

#include "hal/messages/settings.h"
#include "host/child/child.h"
#include "host/child/environment.h"
#include "host/render/events/events.h"
#include "host/render/resume/resume.h"
#include "host/render/sinks/frame_folder.h"
#include "host/shell/launch/background_text.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/display.h"
#include "host/shell/launch/session_folders.h"

namespace mars::launch {

namespace {

constexpr std::size_t kLastWords = 400;         // lines: each rank may report the same loss in a dozen of its own
constexpr std::size_t kLongestWords = 4096;     // bytes of such a line
constexpr std::chrono::seconds kSlowStart{20};  // of waiting for nodes, until a person learns that none has answered
constexpr std::chrono::seconds kSlowLoad{3};    // of compiling the film, until a person learns what takes so long
constexpr std::chrono::seconds kLongestTrial{30};

child::Command command_for(options::RenderOptions& options, const std::filesystem::path& self) {
  const std::string path = child::program_path(child::own_environment());
  const Programs programs = find_programs(self, path);
  options.backend = choose_backend(options.backend, programs);
  const Surroundings surroundings = look_around(path);
  if (options.nodes == 0) options.nodes = default_nodes(options, surroundings);
  if (options.backend == options::Backend::threads) return threads_command(options, programs);
  if (options.backend == options::Backend::simulated) return simulated_command(options, programs);
  return mpi_command(options, programs, surroundings);
}

// Follows one run from its events to its end.
class Run {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Run(Display& display) : display_(display) {}

  // `waited` is called once when nodes have been waited for for `patience` and did not all answer; `tick` now and then.
  void follow(const child::Command& command, Clock::duration patience, const std::function<void(child::Child&)>& waited,
              const std::function<void()>& tick) {
    remains_.program = command.words.front();
    bool overdue = false;
    child::Command started = command;
    const SessionFolders folders(started);
    child::Child child(started);
    remains_.ending = child.wait({[this](const std::string& line) { take_output(line); },
                                  [this](const std::string& line) { take_error(line); },
                                  [&] {
                                    tick();
                                    if (remains_.booted) return display_.show(remains_.progress);
                                    if (loading_) return show_slow_load();
                                    if (overdue || Clock::now() - waiting_since_ < patience) return;
                                    overdue = true;
                                    waited(child);
                                  }});
    remains_.passed_on = child.passed_on();
  }

  bool well() const { return done_ && remains_.ending.well(); }
  const events::Done& done() const { return *done_; }
  const Remains& remains() const { return remains_; }
  double boot_seconds() const { return boot_seconds_; }

 private:
  void take_output(const std::string& line) {
    const std::optional<events::Event> event = events::read_event(line);
    if (!event) return take_error(line);  // the words of an mpirun
    if (const auto* loading = std::get_if<events::Loading>(&*event)) begin_loading(*loading);
    if (const auto* loaded = std::get_if<events::Loaded>(&*event)) end_loading(*loaded);
    if (const auto* warning = std::get_if<events::Warning>(&*event))
      std::cerr << "mars: warning: " << warning->text << '\n';
    if (const auto* resumed = std::get_if<events::Resumed>(&*event)) display_.print(resumed_text(*resumed));
    if (const auto* booted = std::get_if<events::Booted>(&*event)) {
      display_.print(booted_text(*booted));
      remains_.booted = *booted;
      boot_seconds_ = std::chrono::duration<double>(Clock::now() - started_).count();
    }
    if (const auto* progress = std::get_if<events::Progress>(&*event)) remains_.progress = *progress;
    if (const auto* fault = std::get_if<events::Fault>(&*event); fault && !remains_.fault) remains_.fault = *fault;
    if (const auto* done = std::get_if<events::Done>(&*event)) done_ = *done;
  }

  void begin_loading(const events::Loading& loading) {
    loading_ = loading;
    waiting_since_ = Clock::now();
  }

  void show_slow_load() {
    if (slow_load_shown_ || Clock::now() - waiting_since_ < kSlowLoad) return;
    slow_load_shown_ = true;
    display_.print("loading " + loading_->film + " ...");
  }

  // Nodes are waited for only from now on: the host does not listen to them before.
  void end_loading(const events::Loaded& loaded) {
    loading_.reset();
    waiting_since_ = Clock::now();
    if (slow_load_shown_) display_.print("loaded in " + clock_text(loaded.seconds));
  }

  void take_error(const std::string& line) {
    remains_.last_words.push_back(line.substr(0, kLongestWords));
    if (remains_.last_words.size() > kLastWords) remains_.last_words.pop_front();
  }

  Display& display_;
  const Clock::time_point started_ = Clock::now();
  Clock::time_point waiting_since_ = started_;  // for nodes; while loading_, for the film
  std::optional<events::Loading> loading_;
  bool slow_load_shown_ = false;
  double boot_seconds_ = 0;
  std::optional<events::Done> done_;
  Remains remains_;
};

// The number of frames, where nothing is left to render; of a measurement the host says so.
std::optional<std::uint32_t> frames_there(const options::RenderOptions& options) {
  const bool measures = !options.report.empty() || !options.trace.empty();
  if (options.sink == options::SinkKind::none || measures) return std::nullopt;
  return resume::count_if_complete({options.folder, options.film, options::film_arguments(options), options.format,
                                    options.frames, options.overwrite});
}

}  // namespace

void launch_render(options::RenderOptions options, const std::filesystem::path& self, const Adviser& adviser) {
  Display display(kind_of_output(options.quiet), std::cout);
  for (const std::string& line : messages::unknown_settings()) display.print(line);
  messages::read_settings();  // wrong settings fail before anything is started
  if (const auto there = frames_there(options)) {
    sinks::clear_ended_runs(options.folder);
    return display.print(resumed_text({*there, *there, ""}));
  }
  const child::Command command = command_for(options, self);
  display.print(shell_text(command));
  const Advice advice = [&] { return adviser.after_a_failed_start(options); };
  BackgroundText hint;
  Run run(display);
  run.follow(
      command, kSlowStart,
      [&](child::Child&) {
        display.print("no node has answered for " + std::to_string(kSlowStart.count()) + " seconds");
        hint.begin([ask = adviser.while_it_starts, options] { return ask(options); });
      },
      [&] {
        if (const std::string text = hint.take(); !text.empty()) display.print(text);
      });
  display.settle();
  if (!run.well()) {
    const Failure failure = diagnose(run.remains(), options, advice);
    if (!options.folder.empty()) sinks::clear_ended_runs(options.folder);
    throw failure;
  }
  if (run.done().frames > 0) display.print(done_text(run.done()));
}

Trial try_start(options::RenderOptions options, const std::filesystem::path& self) {
  options.film = options::kTrialFilm;
  options.sink = options::SinkKind::none;
  messages::read_settings();
  const child::Command command = command_for(options, self);
  Display nothing(Display::Kind::silent, std::cout);
  Run run(nothing);
  bool given_up = false;
  run.follow(
      command, kLongestTrial,
      [&](child::Child& child) {
        given_up = true;
        child.stop();
      },
      [] {});
  if (run.remains().passed_on != 0) throw stopped(run.remains(), options);
  Trial trial{shell_text(command), run.boot_seconds(), {}, 0, std::nullopt};
  if (const auto& booted = run.remains().booted) trial.booted = *booted;
  if (run.well()) {
    trial.frames = run.done().frames;
  } else if (given_up) {
    trial.failure = Failure("no node has answered for " + std::to_string(kLongestTrial.count()) + " seconds", "",
                            "see whether the machines reach each other, and what the line below says by itself");
  } else {
    trial.failure = diagnose(run.remains(), options, [] { return std::string(); });
  }
  return trial;
}

}  // namespace mars::launch
