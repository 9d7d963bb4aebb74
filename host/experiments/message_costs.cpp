#include "host/experiments/message_costs.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "hal/nx/nx_messages.h"

namespace mars::experiments {
namespace {

constexpr long kPing = 1, kPong = 2, kCosts = 3;
constexpr int kRepeats = 30;
constexpr long kLong = 4 << 20;

// The least of several.
template <typename Act>
double least_seconds(const Act& act) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepeats; ++i) {
    const double begun = dclock();
    act();
    least = std::min(least, dclock() - begun);
  }
  return least;
}

constexpr int kRounds = 100, kBurst = 200;

MessageCosts measure() {
  std::vector<char> bytes(kLong);
  const auto round = [&](long length) {
    csend(kPing, bytes.data(), length, 1, 0);
    crecv(kPong, bytes.data(), length);
  };
  const double there_and_back = least_seconds([&] {
    for (int i = 0; i < kRounds; ++i) round(0);
  });
  const double with_bytes = least_seconds([&] { round(kLong); });
  const double burst = least_seconds([&] {
    for (int i = 0; i < kBurst; ++i) csend(kPing, nullptr, 0, 1, 0);
    crecv(kPong, nullptr, 0);
  });
  MessageCosts costs;
  const double one_way = there_and_back / kRounds / 2;
  costs.end = std::min(burst / kBurst, one_way / 2);
  costs.latency = one_way - 2 * costs.end;
  costs.rate = kLong / std::max(with_bytes / 2 - one_way, 1e-9);
  return costs;
}

void answer() {
  std::vector<char> bytes(kLong);
  const auto rounds = [&](int count, long length) {
    for (int i = 0; i < count; ++i) {
      crecv(kPing, bytes.data(), length);
      csend(kPong, bytes.data(), length, 0, 0);
    }
  };
  rounds(kRepeats * kRounds, 0);
  rounds(kRepeats, kLong);
  for (int i = 0; i < kRepeats; ++i) {
    for (int k = 0; k < kBurst; ++k) crecv(kPing, nullptr, 0);
    csend(kPong, nullptr, 0, 0, 0);
  }
}

}  // namespace

void exchange_messages() {
  if (mynode() == 1) answer();
  if (mynode() != 0) return;
  const MessageCosts costs = measure();
  csend(kCosts, &costs, sizeof costs, myhost(), 0);
}

MessageCosts receive_costs() {
  MessageCosts costs;
  crecv(kCosts, &costs, sizeof costs);
  return costs;
}

}  // namespace mars::experiments
