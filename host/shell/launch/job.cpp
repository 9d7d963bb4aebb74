#include "host/shell/launch/job.h"

#include <iostream>

#include "host/shell/launch/session_folders.h"

namespace mars::launch {

namespace {

constexpr std::size_t kLastWords = 400;       // lines: each rank may report the same loss in a dozen of its own
constexpr std::size_t kLongestWords = 4096;   // bytes of such a line
constexpr std::chrono::seconds kSlowLoad{3};  // of compiling the film, until a person learns what takes so long

}  // namespace

void Job::follow(const child::Command& command, const Listener& listener) {
  remains_.program = command.words.front();
  child::Command started = command;
  const SessionFolders folders(started);
  child::Child child(started);
  remains_.ending =
      child.wait({[&](const std::string& line) { take_output(line); },
                  [&](const std::string& line) { take_error(line); }, [&] { look_after(child, listener); }});
  remains_.passed_on = child.passed_on();
  if (command.open_mpi == child::OpenMpi::on_several && !remains_.ending.well()) remove_session_of(child.id());
}

void Job::look_after(child::Child& child, const Listener& listener) {
  listener.tick();
  if (listener.is_in_vain && listener.is_in_vain()) child.stop();
  end_if_it_hangs(child);
  if (remains_.booted) return display_.show(remains_.progress);
  if (loading_) return show_slow_load();
  if (overdue_ || Clock::now() - waiting_since_ < listener.patience) return;
  overdue_ = true;
  listener.waited(child);
}

void Job::end_if_it_hangs(child::Child& child) {
  const JobWatch::Findings found = watch_.look(Clock::now());
  for (const std::string& line : found.lines) display_.print(line);
  if (found.end.empty() || !remains_.ended_for.empty()) return;
  remains_.ended_for = found.end;
  child.stop();
}

void Job::take_output(const std::string& line) {
  const std::optional<events::Event> event = events::read_event(line);
  if (!event) return take_error(line);  // the words of an mpirun
  watch_.hear(*event);
  take(*event);
}

void Job::take(const events::Event& event) {
  if (const auto* loading = std::get_if<events::Loading>(&event)) begin_loading(*loading);
  if (const auto* loaded = std::get_if<events::Loaded>(&event)) end_loading(*loaded);
  if (const auto* warning = std::get_if<events::Warning>(&event))
    std::cerr << "mars: warning: " << warning->text << '\n';
  if (const auto* resumed = std::get_if<events::Resumed>(&event)) {
    display_.print(resumed_text(*resumed));
    remains_.resumed = *resumed;
  }
  if (const auto* booted = std::get_if<events::Booted>(&event)) {
    display_.print(booted_text(*booted));
    remains_.booted = *booted;
    boot_seconds_ = std::chrono::duration<double>(Clock::now() - started_).count();
  }
  if (const auto* progress = std::get_if<events::Progress>(&event)) remains_.progress = *progress;
  if (const auto* frame = std::get_if<events::FrameTaken>(&event)) remains_.taken.push_back(frame->number);
  if (const auto* drawing = std::get_if<events::Drawing>(&event)) remains_.drawing = *drawing;
  if (const auto* fault = std::get_if<events::Fault>(&event); fault && !remains_.fault) remains_.fault = *fault;
  if (const auto* done = std::get_if<events::Done>(&event)) remains_.done = *done;
}

void Job::begin_loading(const events::Loading& loading) {
  loading_ = loading;
  waiting_since_ = Clock::now();
}

void Job::show_slow_load() {
  if (slow_load_shown_ || Clock::now() - waiting_since_ < kSlowLoad) return;
  slow_load_shown_ = true;
  display_.print("loading " + loading_->film + " ...");
}

// Nodes are waited for only from now on: the host does not listen to them before.
void Job::end_loading(const events::Loaded& loaded) {
  remains_.run = loaded.run;
  loading_.reset();
  waiting_since_ = Clock::now();
  if (slow_load_shown_) display_.print("loaded in " + clock_text(loaded.seconds));
}

void Job::take_error(const std::string& line) {
  remains_.last_words.push_back(line.substr(0, kLongestWords));
  if (remains_.last_words.size() > kLastWords) remains_.last_words.pop_front();
}

}  // namespace mars::launch
