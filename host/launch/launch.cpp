#include "host/launch/launch.h"

#include <algorithm>
#include <iostream>

#include "hal/settings.h"
#include "host/events/events.h"
#include "host/launch/child.h"
#include "host/launch/command.h"
#include "host/launch/diagnosis.h"
#include "host/launch/display.h"
#include "host/launch/environment.h"
#include "host/sinks/frame_folder.h"
#include "topology/machine.h"

namespace mars::host {

namespace {

constexpr std::size_t kLastWords = 40;  // lines

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
  explicit Run(Display& display) : display_(display) {}

  void follow(const Command& command) {
    remains_.program = command.words.front();
    Child child(command);
    remains_.ending = child.wait({[this](const std::string& line) { take_output(line); },
                                  [this](const std::string& line) { take_error(line); },
                                  [this] {
                                    if (remains_.booted) display_.show(remains_.progress);
                                  }});
    remains_.passed_on = child.passed_on();
  }

  bool well() const { return done_ && remains_.ending.code == 0 && remains_.ending.signal == 0; }
  const Done& done() const { return *done_; }
  const Remains& remains() const { return remains_; }

 private:
  void take_output(const std::string& line) {
    const std::optional<Event> event = read_event(line);
    if (!event) return;
    if (const auto* booted = std::get_if<Booted>(&*event)) {
      display_.tell(booted_text(*booted));
      remains_.booted = *booted;
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
  std::optional<Done> done_;
  Remains remains_;
};

}  // namespace

void launch_render(RenderOptions options, const std::filesystem::path& self) {
  Display display(kind_of_output(options.quiet), std::cout);
  for (const std::string& line : hal::unknown_settings()) display.tell(line);
  hal::read_settings();  // what makes no sense is told before anything is started
  const Command command = command_for(options, self);
  display.tell(shell_text(command));
  Run run(display);
  run.follow(command);
  display.settle();
  if (!run.well()) {
    if (!options.folder.empty()) remove_parts(options.folder);
    throw diagnose(run.remains(), options);
  }
  display.tell(done_text(run.done()));
}

}  // namespace mars::host
