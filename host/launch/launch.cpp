#include "host/launch/launch.h"

#include <algorithm>
#include <chrono>
#include <iostream>

#include "hal/settings.h"
#include "host/events/events.h"
#include "host/launch/child.h"
#include "host/launch/command.h"
#include "host/launch/display.h"
#include "host/launch/environment.h"
#include "host/sinks/frame_folder.h"
#include "topology/machine.h"

namespace mars::host {

namespace {

constexpr std::size_t kLastWords = 400;  // lines: each rank may tell the same loss in its own dozen
constexpr std::chrono::seconds kSlowStart{20};  // until a person is told that no node has answered
constexpr std::chrono::seconds kLongestTrial{30};

Command command_for(RenderOptions& options, const std::filesystem::path& self) {
  const std::string path = own_environment().value("PATH").value_or("/usr/bin:/bin");
  const Programs programs = find_programs(self, path);
  options.backend = choose_backend(options.backend, programs);
  const Surroundings surroundings = look_around(path);
  if (options.nodes == 0) options.nodes = default_nodes(options, surroundings);
  if (options.backend == Backend::threads) return threads_command(options, programs);
  return mpi_command(options, programs, surroundings);
}

// Follows one run from its events to its end.
class Run {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Run(Display& display) : display_(display) {}

  // `waited` is called once when no node has answered for `patience`.
  void follow(const Command& command, Clock::duration patience, const std::function<void(Child&)>& waited) {
    remains_.program = command.words.front();
    const Clock::time_point deadline = started_ + patience;
    bool told = false;
    Child child(command);
    remains_.ending = child.wait({[this](const std::string& line) { take_output(line); },
                                  [this](const std::string& line) { take_error(line); },
                                  [&] {
                                    if (remains_.booted) return display_.show(remains_.progress);
                                    if (told || Clock::now() < deadline) return;
                                    told = true;
                                    waited(child);
                                  }});
    remains_.passed_on = child.passed_on();
  }

  bool well() const { return done_ && remains_.ending.code == 0 && remains_.ending.signal == 0; }
  const Done& done() const { return *done_; }
  const Remains& remains() const { return remains_; }
  double boot_seconds() const { return boot_seconds_; }

 private:
  void take_output(const std::string& line) {
    const std::optional<Event> event = read_event(line);
    if (!event) return take_error(line);  // the words of an mpirun
    if (const auto* booted = std::get_if<Booted>(&*event)) {
      display_.tell(booted_text(*booted));
      remains_.booted = *booted;
      boot_seconds_ = std::chrono::duration<double>(Clock::now() - started_).count();
    }
    if (const auto* progress = std::get_if<Progress>(&*event)) remains_.progress = *progress;
    if (const auto* fault = std::get_if<Fault>(&*event); fault && !remains_.fault) remains_.fault = *fault;
    if (const auto* done = std::get_if<Done>(&*event)) done_ = *done;
  }

  void take_error(const std::string& line) {
    remains_.last_words.push_back(line);
    if (remains_.last_words.size() > kLastWords) remains_.last_words.pop_front();
  }

  Display& display_;
  Clock::time_point started_ = Clock::now();
  double boot_seconds_ = 0;
  std::optional<Done> done_;
  Remains remains_;
};

}  // namespace

void launch_render(RenderOptions options, const std::filesystem::path& self, const Adviser& adviser) {
  Display display(kind_of_output(options.quiet), std::cout);
  for (const std::string& line : hal::unknown_settings()) display.tell(line);
  hal::read_settings();  // what makes no sense is told before anything is started
  const Command command = command_for(options, self);
  display.tell(shell_text(command));
  const Advice advice = [&] { return adviser(options); };
  Run run(display);
  run.follow(command, kSlowStart,
             [&](Child&) { display.tell("no node has answered yet; is this why?\n" + advice()); });
  display.settle();
  if (!run.well()) {
    if (!options.folder.empty()) clear_ended_runs(options.folder);
    throw diagnose(run.remains(), options, advice);
  }
  display.tell(done_text(run.done()));
}

Trial try_start(RenderOptions options, const std::filesystem::path& self) {
  options.film = kTrialFilm;
  options.sink = SinkKind::none;
  hal::read_settings();
  const Command command = command_for(options, self);
  Display nothing(Display::Kind::silent, std::cout);
  Run run(nothing);
  bool given_up = false;
  run.follow(command, kLongestTrial, [&](Child& child) {
    given_up = true;
    child.stop();
  });
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

}  // namespace mars::host
