#include "host/child/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "hal/failure/failure.h"
#include "host/child/descriptor.h"
#include "host/child/exec.h"
#include "topology/memory_limit.h"

namespace mars::child {
namespace {

constexpr std::chrono::seconds kLongestKill{1};  // until what the kernel holds is left
constexpr int kFree = 10;                        // descriptors from here on are nobody's streams

void lower_limit(int resource, std::uint64_t most) {
  rlimit now{};
  getrlimit(static_cast<__rlimit_resource>(resource), &now);
  now.rlim_cur = std::min<rlim_t>({now.rlim_cur, now.rlim_max, most});
  setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

// In the new process: nothing but system calls, for other threads may have held any lock. False with errno.
bool set_up(const ProcessSetup& setup, pid_t parent, std::vector<int>& sources) {
  if (setup.own_group) setpgid(0, 0);
  if (setup.signal_at_our_end != 0) {
    prctl(PR_SET_PDEATHSIG, setup.signal_at_our_end);
    if (getppid() != parent) _exit(1);  // it ended before
  }
  for (const int signal : setup.default_signals) std::signal(signal, SIG_DFL);
  // Out of the way first: a number to be set may be another stream's descriptor.
  for (std::size_t i = 0; i < setup.streams.size(); ++i)
    if ((sources[i] = fcntl(setup.streams[i].descriptor, F_DUPFD_CLOEXEC, kFree)) < 0) return false;
  for (std::size_t i = 0; i < setup.streams.size(); ++i)
    if (dup2(sources[i], setup.streams[i].number) < 0) return false;
  if (setup.niceness != 0) setpriority(PRIO_PROCESS, 0, setup.niceness);
  if (setup.limits) {
    lower_limit(RLIMIT_CORE, 0);
    lower_limit(RLIMIT_CPU, static_cast<std::uint64_t>(setup.limits->processor_time.count()));
    lower_limit(RLIMIT_AS, setup.limits->memory);
  }
  return true;
}

// Everything that the new process needs is made before the fork. Limits count from what this process has. SIGCHLD
// ignored, as whoever started us may leave it, would keep from us how the new process ends.
struct Preparation {
  explicit Preparation(const ProcessSetup& wanted) : setup(wanted), sources(wanted.streams.size()) {
    std::signal(SIGCHLD, SIG_DFL);
    if (setup.limits) setup.limits->memory += topology::process_memory().addresses;
  }

  ProcessSetup setup;
  std::vector<int> sources;
  pid_t parent = getpid();
};

[[noreturn]] void fail_to_start(const std::string& program, int reason) {
  throw Failure(std::string("cannot be started: ") + std::strerror(reason), program, "");
}

}  // namespace

// The pipe closes by itself when the program takes over, or brings the reason why it could not.
Process::Process(const Command& command, const ProcessSetup& setup) : leads_group_(setup.own_group) {
  const ExecArguments arguments(command);
  Preparation prepared(setup);
  Pipe reasons = make_pipe();
  const int answer = fcntl(reasons.writing.number(), F_DUPFD_CLOEXEC, kFree);
  if (answer < 0) fail_to_start(command.words.front(), errno);
  reasons.writing = Descriptor(answer);
  id_ = fork();
  if (id_ == 0) {
    if (set_up(prepared.setup, prepared.parent, prepared.sources)) arguments.execute();
    const int reason = errno;
    [[maybe_unused]] const ssize_t written = write(answer, &reason, sizeof reason);
    _exit(127);
  }
  int reason = id_ < 0 ? errno : 0;
  reasons.writing.close();
  if (id_ > 0 && read(reasons.reading.number(), &reason, sizeof reason) == sizeof reason) waitpid(id_, nullptr, 0);
  if (reason != 0) fail_to_start(command.words.front(), reason);
}

Process::Process(const std::function<int()>& work, const ProcessSetup& setup) : leads_group_(setup.own_group) {
  Preparation prepared(setup);
  id_ = fork();
  if (id_ == 0) _exit(set_up(prepared.setup, prepared.parent, prepared.sources) ? work() : 1);
  if (id_ < 0) throw Failure(std::strerror(errno), "starting a process", "");
}

Process::~Process() {
  if (left_) return;
  send(SIGKILL);
  const auto last = std::chrono::steady_clock::now() + kLongestKill;
  while (!poll() && std::chrono::steady_clock::now() < last) ::poll(nullptr, 0, 1);
}

std::optional<Ending> Process::ending(int options) {
  int status = 0;
  pid_t ended = -1;
  while ((ended = waitpid(id_, &status, options)) < 0 && errno == EINTR) {
  }
  if (ended == 0) return std::nullopt;
  left_ = true;
  if (ended < 0) return Ending{1, 0};  // something else took its end: nobody knows that it went well
  return WIFSIGNALED(status) ? Ending{0, WTERMSIG(status)} : Ending{WEXITSTATUS(status), 0};
}

Ending Process::wait() { return *ending(0); }

std::optional<Ending> Process::poll() { return ending(WNOHANG); }

void Process::send(int signal) const { kill(leads_group_ ? -id_ : id_, signal); }

}  // namespace mars::child
