#include "host/child/signal_relay.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>

#include "hal/failure/failure.h"

namespace mars::child {

namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

// What the handler knows.
std::atomic<pid_t> relay_group{0};
std::atomic<int> relay_count{0};
std::atomic<int> relay_first{0};
std::atomic<bool> relay_here{false};
static_assert(std::atomic<pid_t>::is_always_lock_free);
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

// Nothing but system calls and the atomics above.
void relay(int signal) {
  const int error = errno;
  const bool again = relay_count++ > 0;
  if (!again) relay_first = signal;
  if (const pid_t group = relay_group; group > 0) signal_group(group, again ? SIGKILL : signal);
  alarm(static_cast<unsigned>((again ? SignalRelay::kLongestOnceMore : SignalRelay::kLongest).count()));
  errno = error;
}

void end_here(int) {
  if (const pid_t group = relay_group; group > 0) kill(-group, SIGKILL);
  _exit(1);
}

struct sigaction handled_by(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // output is not cut off; the waits that must end are polls, which never restart
  for (const int signal : kSignals) sigaddset(&action.sa_mask, signal);
  return action;
}

}  // namespace

void signal_group(pid_t group, int signal) {
  kill(-group, signal);
  kill(-group, SIGCONT);
}

SignalRelay::SignalRelay() : within_another_(relay_here.exchange(true)) {
  check(relay_group == 0, "one child at a time");
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
  relay_group = 0;
  if (within_another_) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  relay_here = false;
}

int SignalRelay::count() const { return relay_count; }
int SignalRelay::first() const { return relay_first; }

// The group before what came, where the handler has what came before the group: so one of them sends it, also where
// the signal is handled by another thread.
void SignalRelay::relay_to(pid_t group) {
  relay_group = group;
  if (const int came_before = relay_first; came_before != 0)
    signal_group(group, relay_count > 1 ? SIGKILL : came_before);
}

void SignalRelay::forget_group() { relay_group = 0; }

}  // namespace mars::child
