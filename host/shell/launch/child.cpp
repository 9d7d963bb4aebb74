#include "host/shell/launch/child.h"

#include <fcntl.h>
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

#include "host/shell/launch/exec.h"

namespace mars::host {

namespace {

constexpr std::size_t kLongestLine = 16 << 20;  // bytes; a longer one comes in pieces
constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kSilentTick{5};  // once its output has ended: so will it
constexpr std::chrono::seconds kGrace{6};            // from a signal passed on to the kill; mpirun takes up to five
constexpr std::chrono::seconds kDraining{3};         // from its end to the kill of what it left
constexpr std::chrono::seconds kReaping{1};          // from a kill to giving up on what the kernel holds
static_assert(kGrace + kReaping + kDraining + kReaping < SignalRelay::kLongest);
static_assert(kReaping + kDraining + kReaping < SignalRelay::kLongestOnceMore);

struct Pipe {
  std::array<int, 2> ends{-1, -1};  // read, write

  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) == 0) return;
    const char* remedy = errno == EMFILE ? "raise ulimit -n" : "";
    throw Failure(std::strerror(errno), "starting a program", remedy);
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int keep_reading_end() { return std::exchange(ends[0], -1); }
};

// In the new process, after fork: nothing but system calls.
[[noreturn]] void become(const ExecArguments& arguments, int output, int error, int reason_pipe, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  // What was started in a shell's background ignores SIGINT, but not when it is we who pass it on.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0 && dup2(nothing, 0) >= 0 && dup2(output, 1) >= 0 && dup2(error, 2) >= 0) {
    execve(arguments.words()[0], arguments.words(), arguments.environment());
  }
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = write(reason_pipe, &reason, sizeof reason);
  _exit(127);
}

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
  std::signal(SIGCHLD, SIG_DFL);  // ignored, as whoever started us may do, it would keep children's ends from us
  strangers_ = children_of_ours();
  Pipe output;
  Pipe error;
  start(command, output.ends[1], error.ends[1]);
  relay_.emplace(process_);
  output_.descriptor = output.keep_reading_end();
  error_.descriptor = error.keep_reading_end();
}

Child::~Child() {
  if (!status_ && !given_up_) {
    kill(-process_, SIGKILL);
    const auto last = Clock::now() + kReaping;
    while (waitpid(process_, nullptr, WNOHANG) == 0 && Clock::now() < last) poll(nullptr, 0, 1);
  }
  for (const int descriptor : {output_.descriptor, error_.descriptor})
    if (descriptor >= 0) close(descriptor);
}

// `reason_pipe` closes by itself when the program takes over, or brings the reason why it could not.
void Child::start(const Command& command, int output, int error) {
  const ExecArguments arguments(command);
  Pipe reason_pipe;
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become(arguments, output, error, reason_pipe.ends[1], parent);
  close(std::exchange(reason_pipe.ends[1], -1));
  int reason = process_ < 0 ? errno : 0;
  if (process_ > 0 && read(reason_pipe.ends[0], &reason, sizeof reason) == sizeof reason)
    waitpid(process_, nullptr, 0);
  if (reason == 0) return;
  throw Failure(std::string("cannot be started: ") + std::strerror(reason), command.words.front(), "");
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
  if (!status_) return {0, SIGKILL};
  return WIFSIGNALED(*status_) ? Ending{0, WTERMSIG(*status_)} : Ending{WEXITSTATUS(*status_), 0};
}

void Child::wait_for_output() {
  std::array<pollfd, 2> ready{{{output_.descriptor, POLLIN, 0}, {error_.descriptor, POLLIN, 0}}};
  const bool silent = output_.descriptor < 0 && error_.descriptor < 0;
  poll(ready.data(), ready.size(), static_cast<int>((silent ? kSilentTick : kTick).count()));
}

// One piece of what there is: the other stream, the signals and the tick have their turn.
void Child::take(Stream& stream, const std::function<void(const std::string&)>& listener) {
  pollfd ready{stream.descriptor, POLLIN, 0};
  if (stream.descriptor < 0 || poll(&ready, 1, 0) <= 0) return;
  std::array<char, 65536> bytes;
  const ssize_t count = read(stream.descriptor, bytes.data(), bytes.size());
  if (count < 0) return;
  std::size_t first = 0, searched = stream.rest.size();
  stream.rest.append(bytes.data(), static_cast<std::size_t>(count));
  for (std::size_t end; (end = stream.rest.find('\n', searched)) != std::string::npos; first = searched = end + 1) {
    listener(stream.rest.substr(first, end - first));
  }
  stream.rest.erase(0, first);
  const bool last = count == 0;
  if (!stream.rest.empty() && (last || stream.rest.size() > kLongestLine)) listener(std::exchange(stream.rest, ""));
  if (last) close(std::exchange(stream.descriptor, -1));
}

void Child::reap() {
  int status = 0;
  if (!status_ && waitpid(process_, &status, WNOHANG) == process_) {
    status_ = status;
    stage_ = Stage::draining;
    deadline_ = Clock::now() + kDraining;
  }
  if (!status_) return;
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
  if (status_) return;
  stage_ = again ? Stage::killed : Stage::asked_to_end;
  deadline_ = Clock::now() + (again ? kReaping : kGrace);
}

void Child::end_what_is_due() {
  switch (stage_) {
    case Stage::running:
    case Stage::asked_to_end:
      kill(-process_, SIGKILL);
      stage_ = Stage::killed;
      deadline_ = Clock::now() + kReaping;
      return;
    case Stage::draining:
      stage_ = Stage::orphans_killed;
      deadline_ = Clock::now() + kReaping;
      return;
    case Stage::killed:
    case Stage::orphans_killed:
      given_up_ = true;
  }
}

void Child::stop() {
  if (stage_ != Stage::running) return;
  signal_group(process_, SIGTERM);
  stage_ = Stage::asked_to_end;
  deadline_ = Clock::now() + kGrace;
}

void fail_if_stopped(const Child& child) {
  if (child.passed_on() != 0) throw Failure("stopped by " + std::string(strsignal(child.passed_on())), "", "");
}

}  // namespace mars::host
