#include "host/launch/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "hal/failure.h"
#include "host/launch/environment.h"

namespace mars::host {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::seconds kGrace{6};     // from a signal passed on to the kill; mpirun takes up to five
constexpr std::chrono::seconds kDraining{3};  // from its end to the kill of what it left
constexpr std::chrono::seconds kReaping{1};   // from that to giving up on what the kernel holds

struct Pipe {
  std::array<int, 2> ends{-1, -1};  // read, write

  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Failure(std::strerror(errno), "starting a program", "");
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int keep_reading_end() { return std::exchange(ends[0], -1); }
};

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&set, signal);
  return set;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// In the new process, after fork: nothing but system calls.
[[noreturn]] void become(char** words, char** environment, int output, int error, int told,
                         const sigset_t& signals, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  // What was started in a shell's background ignores SIGINT, but not when it is we who pass it on.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0 && dup2(nothing, 0) >= 0 && dup2(output, 1) >= 0 && dup2(error, 2) >= 0) {
    execve(words[0], words, environment);
  }
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = write(told, &reason, sizeof reason);
  _exit(127);
}

// What it left when it ended.
void kill_orphans() {
  std::ifstream list("/proc/self/task/" + std::to_string(getpid()) + "/children");
  for (pid_t orphan; list >> orphan;) kill(orphan, SIGKILL);
}

}  // namespace

Child::Child(const Command& command) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const sigset_t watched = watched_signals();
  sigprocmask(SIG_BLOCK, &watched, &signals_before_);
  signals_ = signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK);
  Pipe output;
  Pipe error;
  start(command, output.ends[1], error.ends[1]);
  output_.descriptor = output.keep_reading_end();
  error_.descriptor = error.keep_reading_end();
}

Child::~Child() {
  if (!status_) {
    kill(-process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  for (const int descriptor : {output_.descriptor, error_.descriptor, signals_})
    if (descriptor >= 0) close(descriptor);
  sigprocmask(SIG_SETMASK, &signals_before_, nullptr);
}

// The pipe `told` closes by itself when the program takes over, or brings the reason why it could not.
void Child::start(const Command& command, int output, int error) {
  std::vector<std::string> words = command.words;
  Environment environment = own_environment();
  for (const auto& [name, value] : command.environment) environment.set(name, value);
  const std::vector<char*> word_pointers = pointers(words);
  const std::vector<char*> environment_pointers = environment.pointers();
  Pipe told;
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {
    become(const_cast<char**>(word_pointers.data()), const_cast<char**>(environment_pointers.data()), output,
           error, told.ends[1], signals_before_, parent);
  }
  close(std::exchange(told.ends[1], -1));
  int reason = process_ < 0 ? errno : 0;
  if (process_ > 0 && read(told.ends[0], &reason, sizeof reason) == sizeof reason)
    waitpid(process_, nullptr, 0);
  if (reason == 0) return;
  throw Failure(std::string("cannot be started: ") + std::strerror(reason), words.front(), "");
}

Ending Child::wait(const Listener& listener) {
  while (!ended()) {
    std::array<pollfd, 3> ready{
        {{output_.descriptor, POLLIN, 0}, {error_.descriptor, POLLIN, 0}, {signals_, POLLIN, 0}}};
    poll(ready.data(), ready.size(), static_cast<int>(kTick.count()));
    if (ready[0].revents != 0) take(output_, listener.output);
    if (ready[1].revents != 0) take(error_, listener.error);
    if (ready[2].revents != 0) take_signals();
    listener.tick();
    if (!deadline_ || Clock::now() < *deadline_) continue;
    if (status_) {
      if (std::exchange(orphans_killed_, true)) break;
      kill_orphans();
      deadline_ = Clock::now() + kReaping;
      continue;
    }
    kill(-process_, SIGKILL);
    deadline_.reset();
  }
  return WIFSIGNALED(*status_) ? Ending{0, WTERMSIG(*status_)} : Ending{WEXITSTATUS(*status_), 0};
}

void Child::take(Stream& stream, const std::function<void(const std::string&)>& tell) {
  std::array<char, 65536> bytes;
  const ssize_t count = read(stream.descriptor, bytes.data(), bytes.size());
  if (count < 0) return;
  stream.rest.append(bytes.data(), static_cast<std::size_t>(count));
  std::size_t first = 0;
  for (std::size_t end; (end = stream.rest.find('\n', first)) != std::string::npos; first = end + 1) {
    tell(stream.rest.substr(first, end - first));
  }
  stream.rest.erase(0, first);
  if (count > 0) return;
  if (!stream.rest.empty()) tell(stream.rest);
  close(std::exchange(stream.descriptor, -1));
}

void Child::take_signals() {
  signalfd_siginfo signal;
  while (read(signals_, &signal, sizeof signal) == sizeof signal) {
    if (signal.ssi_signo == SIGCHLD) {
      reap();
      continue;
    }
    pass_on(static_cast<int>(signal.ssi_signo));
  }
}

void Child::pass_on(int signal) {
  const bool first = passed_on_ == 0;
  if (first) passed_on_ = signal;
  // Whoever asks twice does not want to wait.
  kill(-process_, first ? signal : SIGKILL);
  if (!status_) deadline_ = Clock::now() + kGrace;
}

void Child::stop() {
  if (passed_on_ == 0) pass_on(SIGTERM);
}

void Child::reap() {
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(-1, &status, WNOHANG)) > 0) {
    if (ended != process_) continue;
    status_ = status;
    deadline_ = Clock::now() + kDraining;
  }
  orphans_ = ended == 0;
}

}  // namespace mars::host
