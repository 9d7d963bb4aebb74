#include "host/child/child.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

namespace mars::child {

namespace {

constexpr std::size_t kLongestLine = 16 << 20;  // bytes; a longer one comes in pieces
constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kSilentTick{5};  // once its output has ended: so will it
constexpr std::chrono::seconds kGrace{6};            // from a signal passed on to the kill; mpirun takes up to five
constexpr std::chrono::seconds kDraining{3};         // from its end to the kill of what it left
constexpr std::chrono::seconds kReaping{1};          // from a kill to giving up on what the kernel holds
static_assert(kGrace + kReaping + kDraining + kReaping < SignalRelay::kLongest);
static_assert(kReaping + kDraining + kReaping < SignalRelay::kLongestOnceMore);

// Those that we started, and those left to us by such that have ended.
std::set<pid_t> children_of_ours() {
  std::set<pid_t> children;
  std::error_code none;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", none)) {
    std::ifstream list(thread.path() / "children");
    for (pid_t child; list >> child;) children.insert(child);
  }
  return children;
}

}  // namespace

Child::Child(const Command& command) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  strangers_ = children_of_ours();
  const Descriptor nothing = null_device();
  Pipe output = make_pipe(), error = make_pipe();
  relay_.emplace();  // first: a signal that comes while the program starts would end us alone
  // What was started in a shell's background ignores SIGINT, but not when it is we who pass it on.
  process_.emplace(
      command,
      ProcessSetup{.streams = {{0, nothing.number()}, {1, output.writing.number()}, {2, error.writing.number()}},
                   .own_group = true,
                   .signal_at_our_end = SIGTERM,
                   .default_signals = {SIGINT, SIGTERM, SIGHUP}});
  relay_->relay_to(process_->id());
  output_.descriptor = std::move(output.reading);
  error_.descriptor = std::move(error.reading);
}

Ending Child::wait(const Listener& listener) {
  while (!ended() && !given_up_) {
    wait_for_output();
    take(output_, listener.output);
    take(error_, listener.error);
    reap();
    listener.tick();
    notice_signals();
    if (Clock::now() >= deadline_) end_what_is_due();
  }
  return ending_.value_or(Ending{0, SIGKILL});
}

void Child::wait_for_output() {
  std::array<pollfd, 2> ready{{{output_.descriptor.number(), POLLIN, 0}, {error_.descriptor.number(), POLLIN, 0}}};
  const bool silent = !output_.descriptor.open() && !error_.descriptor.open();
  poll(ready.data(), ready.size(), static_cast<int>((silent ? kSilentTick : kTick).count()));
}

// One piece of what there is: the other stream, the signals and the tick have their turn.
void Child::take(Stream& stream, const std::function<void(const std::string&)>& listener) {
  pollfd ready{stream.descriptor.number(), POLLIN, 0};
  if (!stream.descriptor.open() || poll(&ready, 1, 0) <= 0) return;
  std::array<char, 65536> bytes;
  const ssize_t count = read(stream.descriptor.number(), bytes.data(), bytes.size());
  if (count < 0) return;
  std::size_t first = 0, searched = stream.rest.size();
  stream.rest.append(bytes.data(), static_cast<std::size_t>(count));
  for (std::size_t end; (end = stream.rest.find('\n', searched)) != std::string::npos; first = searched = end + 1) {
    listener(stream.rest.substr(first, end - first));
  }
  stream.rest.erase(0, first);
  const bool last = count == 0;
  if (!stream.rest.empty() && (last || stream.rest.size() > kLongestLine)) listener(std::exchange(stream.rest, ""));
  if (last) stream.descriptor.close();
}

void Child::reap() {
  if (!ending_ && (ending_ = process_->poll())) {
    stage_ = Stage::draining;
    deadline_ = Clock::now() + kDraining;
  }
  if (!ending_) return;
  orphans_ = false;
  for (const pid_t orphan : children_of_ours()) {
    if (strangers_.contains(orphan)) continue;
    if (stage_ == Stage::orphans_killed) kill(orphan, SIGKILL);
    if (waitpid(orphan, nullptr, WNOHANG) == 0) orphans_ = true;
  }
  if (!orphans_) relay_->forget_group();
}

// The relay has passed them on already.
void Child::notice_signals() {
  const int count = relay_->count();
  if (count == signals_noticed_) return;
  const bool again = count > 1;
  signals_noticed_ = count;
  if (ending_) return;
  stage_ = again ? Stage::killed : Stage::asked_to_end;
  deadline_ = Clock::now() + (again ? kReaping : kGrace);
}

void Child::end_what_is_due() {
  switch (stage_) {
    case Stage::running:
    case Stage::asked_to_end:
      process_->send(SIGKILL);
      stage_ = Stage::killed;
      deadline_ = Clock::now() + kReaping;
      return;
    case Stage::draining:
      stage_ = Stage::orphans_killed;
      deadline_ = Clock::now() + kReaping;
      return;
    case Stage::killed:
    case Stage::orphans_killed: given_up_ = true; process_->give_up();
  }
}

void Child::stop() {
  if (stage_ != Stage::running) return;
  signal_group(process_->id(), SIGTERM);
  stage_ = Stage::asked_to_end;
  deadline_ = Clock::now() + kGrace;
}

void fail_if_stopped(const Child& child) {
  if (child.passed_on() != 0) throw Stopped("stopped by " + std::string(strsignal(child.passed_on())), "", "");
}

TimedEnding wait_at_most(Child& child, std::chrono::milliseconds longest,
                         const std::function<void(const std::string& line)>& output,
                         const std::function<void(const std::string& line)>& error) {
  TimedEnding timed;
  const auto deadline = std::chrono::steady_clock::now() + longest;
  timed.ending = child.wait({output, error, [&] {
                               timed.late = std::chrono::steady_clock::now() > deadline;
                               if (timed.late) child.stop();
                             }});
  fail_if_stopped(child);
  return timed;
}

}  // namespace mars::child
