#include "hal/mpi/patience.h"

#include <sys/prctl.h>

#include <algorithm>

namespace mars::mpi {
namespace {

struct Patience {
  int at_once;  // turns
  int yields;   // turns after these
};
// The yields last longer than the first sleeps, or two that wait for each other fall asleep in turns.
constexpr Patience kEnoughProcessors = {500, 500};
constexpr Patience kTooFewProcessors = {20, 20};

constexpr unsigned long kTimerSlack = 1000;  // nanoseconds
constexpr int kShortestSleep = 10;           // microseconds
constexpr int kSleepsUntilLonger = 4;        // each length is slept so often before it doubles

const Patience& patience(bool oversubscribed) { return oversubscribed ? kTooFewProcessors : kEnoughProcessors; }

}  // namespace

void prepare_to_wait() { prctl(PR_SET_TIMERSLACK, kTimerSlack); }

std::optional<std::chrono::microseconds> pause_of(int turn, bool oversubscribed) {
  const auto [at_once, yields] = patience(oversubscribed);
  if (turn < at_once) return std::nullopt;
  const int sleeps = turn - at_once - yields;
  if (sleeps < 0) return std::chrono::microseconds(0);
  const int doublings = std::min(sleeps / kSleepsUntilLonger, 10);
  return std::chrono::microseconds(kShortestSleep << doublings);
}

int turns_at_once(bool oversubscribed) { return patience(oversubscribed).at_once; }

bool mpi_waits_well() { return false; }

}  // namespace mars::mpi
