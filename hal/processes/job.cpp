#include "hal/processes/job.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

#include "hal/failure/failure.h"
#include "hal/messages/caller.h"

namespace mars::processes {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{200};
constexpr std::chrono::seconds kGrace{3};  // for those that a failure or a signal should end
constexpr int kStandstill = 3;             // ticks after which nothing moves by itself

constexpr std::array kWatched = {SIGINT, SIGTERM, SIGHUP, SIGCHLD};

std::string signal_text(int signal) { return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")"; }

}  // namespace

Job::Job(JobPlan plan)
    : plan_(std::move(plan)), segment_(plan_.nodes, plan_.host, plan_.limit), processes_(segment_.slots()) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  std::signal(SIGCHLD, SIG_DFL);  // ignored, as whoever started us may leave it, it would keep ranks' ends from us
  sigset_t watched;
  sigemptyset(&watched);
  for (const int signal : kWatched) sigaddset(&watched, signal);
  sigprocmask(SIG_BLOCK, &watched, &signals_before_);
  signals_ = signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK);
  std::array<int, 2> ends{};
  if (signals_ < 0 || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw Failure(std::strerror(errno), "starting a job", "see ulimit -n");
  ours_ = ends[0];
  hosts_ = ends[1];
}

Job::~Job() {
  kill_all(SIGKILL);
  // Processes that they had started become ours as they end.
  while (waitpid(-1, nullptr, 0) > 0) kill_all(SIGKILL);
  for (const int descriptor : {ours_, hosts_, signals_}) close(descriptor);
  sigprocmask(SIG_SETMASK, &signals_before_, nullptr);
}

int Job::run() {
  if (plan_.host) start(segment_.nodes(), "");
  if (plan_.begin == JobPlan::Begin::at_once) begin();
  while (running(0, segment_.slots())) {
    std::array<pollfd, 2> ready{{{signals_, POLLIN, 0}, {ours_, POLLIN, 0}}};
    poll(ready.data(), ready.size(), static_cast<int>(kTick.count()));
    if (ready[1].revents != 0) serve();
    if (ready[0].revents != 0) take_signals();
    if (plan_.host && processes_[segment_.nodes()].id == 0) begin();
    look_for_standstill();
    hurry();
  }
  return code_;
}

bool Job::running(int first, int last) const {
  return std::any_of(processes_.begin() + first, processes_.begin() + last,
                     [](const Process& process) { return process.id != 0; });
}

void Job::begin() {
  if (std::exchange(asked_, true) || plan_.begin == JobPlan::Begin::never || segment_.stopped()) return;
  for (int node = 0; node < segment_.header().cube; ++node) start(node, "");
}

void Job::start(int index, const std::string& file) {
  const bool host = index == segment_.nodes();
  Slot& slot = segment_.slot(index);
  slot.begun = ++segment_.header().age;
  slot.life = Life::started;
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t id = fork();
  if (id < 0)
    throw Failure(std::string("cannot start a process: ") + std::strerror(errno), "",
                  "use fewer nodes, or see ulimit -u");
  if (id > 0) {
    processes_[index] = {id, false};
    return;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  sigprocmask(SIG_SETMASK, &signals_before_, nullptr);
  for (const int descriptor : {segment_.descriptor(), host ? hosts_ : -1})
    if (descriptor >= 0) fcntl(descriptor, F_SETFD, 0);
  const int code = plan_.become({index, segment_.descriptor(), host ? hosts_ : -1}, file);
  std::fflush(nullptr);
  _exit(code);
}

void Job::serve() {
  JobRequest request{};
  if (recv(ours_, &request, sizeof request, MSG_DONTWAIT) != sizeof request) return;
  answer(request);
}

void Job::answer(const JobRequest& request) {
  std::int32_t result = 0;
  const bool sensible = request.node >= -1 && request.node < segment_.nodes();
  if (request.what == JobRequest::What::begin) {
    begin();
  } else if (!sensible || (request.what == JobRequest::What::load && request.node < 0)) {
    result = EINVAL;
  } else if (request.what == JobRequest::What::kill) {
    kill_nodes(request.node);
  } else if (processes_[request.node].id != 0) {
    result = EBUSY;
  } else {
    asked_ = true;
    start(request.node, request.file);
  }
  send(ours_, &result, sizeof result, MSG_NOSIGNAL);
}

void Job::kill_nodes(int node) {
  const int first = node < 0 ? 0 : node;
  const int last = node < 0 ? segment_.nodes() : node + 1;
  for (int index = first; index < last; ++index) {
    processes_[index].killed = true;
    if (processes_[index].id != 0) kill(processes_[index].id, SIGKILL);
  }
  for (int index = first; index < last; ++index) {
    int status = 0;
    if (processes_[index].id != 0 && waitpid(processes_[index].id, &status, 0) > 0) note_end(index, status);
  }
  if (node >= 0) return;
  for (int index = first; index < last; ++index) {
    segment_.flush(index);
    segment_.slot(index).life = Life::none;
  }
  segment_.go_on();
  deadline_.reset();
}

void Job::take_signals() {
  signalfd_siginfo signal;
  while (read(signals_, &signal, sizeof signal) == sizeof signal) {
    if (signal.ssi_signo == SIGCHLD) {
      reap();
      continue;
    }
    // A second signal means now. A terminal sends its signals to all processes itself.
    if (passed_on_ != 0)
      kill_all(SIGKILL);
    else if (signal.ssi_code != SI_KERNEL)
      kill_all(static_cast<int>(signal.ssi_signo));
    passed_on_ = static_cast<int>(signal.ssi_signo);
    code_ = 128 + passed_on_;
    segment_.stop("stopped by " + signal_text(passed_on_));
    deadline_ = Clock::now() + kGrace;
  }
}

// Also processes that ranks started and left behind.
void Job::reap() {
  int status = 0;
  for (pid_t ended; (ended = waitpid(-1, &status, WNOHANG)) > 0;) {
    const auto process =
        std::find_if(processes_.begin(), processes_.end(), [&](const Process& each) { return each.id == ended; });
    if (process != processes_.end()) note_end(static_cast<int>(process - processes_.begin()), status);
  }
}

void Job::note_end(int index, int status) {
  const bool killed = processes_[index].killed;
  processes_[index] = {};
  Slot& slot = segment_.slot(index);
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const int code = signal != 0 ? -signal : WEXITSTATUS(status);
  const bool in_order = signal == 0 && slot.life != Life::joined;
  slot.code = code;
  // In this order: a process that reads the new age also reads that this one has ended, and when.
  slot.ended = segment_.header().age + 1;
  slot.life = in_order || killed ? Life::ended : Life::died;
  ++segment_.header().age;
  segment_.flush(index);
  if (!killed) code_ = std::max(code_, signal != 0 ? 128 + signal : code);
  if (signal != 0 && !killed) note_failure(name(index) + " died: " + signal_text(signal));
  if (signal == 0 && !in_order)
    note_failure(name(index) + " ended without leaving its job, with exit code " + std::to_string(code));
  segment_.wake_all();
}

// Nothing moves by itself where every process waits for a message and none is on its way.
bool Job::stands_still() const {
  for (int index = 0; index < segment_.slots(); ++index) {
    const Slot& slot = segment_.slot(index);
    if (processes_[index].id == 0 || slot.waiting == Waiting::for_end) continue;
    if (slot.life != Life::joined || slot.waiting == Waiting::no || slot.arrived != 0 || slot.seen != 0) return false;
  }
  return true;
}

std::uint64_t Job::taken() const {
  std::uint64_t sum = 0;
  for (int index = 0; index < segment_.slots(); ++index) sum += segment_.slot(index).taken;
  return sum;
}

void Job::look_for_standstill() {
  if (Clock::now() < next_look_) return;
  next_look_ = Clock::now() + kTick;
  // Slots are read one after the other: together they are true only if nothing has moved since the last look.
  const std::uint64_t before = std::exchange(last_taken_, taken());
  const bool still = stands_still() && before == last_taken_;
  standing_still_ = still ? standing_still_ + 1 : 0;
  if (standing_still_ < kStandstill || segment_.stopped()) return;
  std::string reason = "every process waits for a message, and none is on its way";
  for (int index = 0; index < segment_.slots(); ++index) {
    const Slot& slot = segment_.slot(index);
    if (slot.life != Life::ended || slot.code == 0) continue;
    reason += "; " + name(index) + " has ended with exit code " + std::to_string(slot.code);
    break;
  }
  note_failure(reason);
}

// The failure that ends the others is reported once.
void Job::note_failure(const std::string& reason) {
  code_ = std::max(code_, 1);
  if (segment_.stopped()) return;
  plan_.report(reason);
  segment_.stop(reason);
}

std::string Job::name(int index) const { return messages::rank_name(index, segment_.nodes()); }

// Only a host can go on after a failure, once it has killed the nodes.
void Job::hurry() {
  const bool host = plan_.host && processes_[segment_.nodes()].id != 0;
  if (segment_.stopped() && !host && !deadline_) deadline_ = Clock::now() + kGrace;
  if (deadline_ && Clock::now() > *deadline_) kill_all(SIGKILL);
}

void Job::kill_all(int signal) {
  for (const Process& process : processes_)
    if (process.id != 0) kill(process.id, signal);
  if (signal != SIGKILL) return;
  std::ifstream list("/proc/self/task/" + std::to_string(getpid()) + "/children");
  for (pid_t child; list >> child;) kill(child, SIGKILL);
}

}  // namespace mars::processes
