#include "host/child/signal_relay.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>

#include "hal/failure/failure.h"

namespace mars::child {

namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

// The handler reads and writes these alone.
std::atomic<pid_t> relay_target{0};  // as kill() names it: a process, or less than 0 for a group; 0: none
std::atomic<int> relay_count{0};
std::atomic<int> relay_first{0};
std::atomic<bool> relay_here{false};
static_assert(std::atomic<pid_t>::is_always_lock_free);
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

// A process of our group is stopped and goes on with us.
void send(pid_t target, int signal) {
  kill(target, signal);
  if (target < 0) kill(target, SIGCONT);
}

// Nothing but system calls and the atomics above. A process of our group has what the terminal sends.
void relay(int signal, siginfo_t* info, void*) {
  const int error = errno;
  const bool again = relay_count++ > 0;
  if (!again) relay_first = signal;
  const pid_t target = relay_target;
  const bool is_there = target > 0 && info->si_code == SI_KERNEL;
  if (target != 0 && (again || !is_there)) send(target, again ? SIGKILL : signal);
  alarm(static_cast<unsigned>((again ? SignalRelay::kLongestOnceMore : SignalRelay::kLongest).count()));
  errno = error;
}

void end_here(int, siginfo_t*, void*) {
  if (const pid_t target = relay_target; target != 0) kill(target, SIGKILL);
  _exit(1);
}

struct sigaction handled_by(void (*handler)(int, siginfo_t*, void*)) {
  struct sigaction action {};
  action.sa_sigaction = handler;
  // Output is not cut off. The waits that must end are polls, which never restart.
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  for (const int signal : kSignals) sigaddset(&action.sa_mask, signal);
  return action;
}

}  // namespace

void signal_group(pid_t group, int signal) { send(-group, signal); }

SignalRelay::SignalRelay() : within_another_(relay_here.exchange(true)) {
  check(relay_target == 0, "one child at a time");
  if (within_another_) return;
  relay_count = relay_first = 0;
  const struct sigaction ending = handled_by(end_here), relaying = handled_by(relay);
  sigaction(SIGALRM, &ending, nullptr);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (kSignals[i] == SIGHUP && before_[i].sa_handler == SIG_IGN) continue;
    sigaction(kSignals[i], &relaying, nullptr);
  }
}

SignalRelay::~SignalRelay() {
  relay_target = 0;
  if (within_another_) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  relay_here = false;
}

int SignalRelay::count() const { return relay_count; }
int SignalRelay::first() const { return relay_first; }

void SignalRelay::relay_to(pid_t group) { relay_to_target(-group); }
void SignalRelay::relay_to_member(pid_t process) { relay_to_target(process); }

// The target before what came, where the handler has what came before the target: so one of them sends it, also where
// the signal is handled by another thread.
void SignalRelay::relay_to_target(pid_t target) {
  relay_target = target;
  if (const int came_before = relay_first; came_before != 0) send(target, relay_count > 1 ? SIGKILL : came_before);
}

void SignalRelay::forget_group() { relay_target = 0; }

}  // namespace mars::child
