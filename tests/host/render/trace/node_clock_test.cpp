#include "host/render/trace/node_clock.h"

#include <gtest/gtest.h>

namespace mars::trace {
namespace {

// A machine that started 1000 seconds after the host's, and whose clock gains 50 millionths.
double foreign_time(double host) { return (host - 1000) * (1 + 50e-6); }

// The question takes `there` seconds, the answer `back`.
ClockReading read_foreign(double now, double there, double back) {
  return ClockReading::of(now, foreign_time(now + there), now + there + back);
}

TEST(NodeClock, OneReadingIsOffByAtMostItsError) {
  for (const auto& [there, back] : {std::pair(1e-5, 1e-5), std::pair(9e-5, 1e-5), std::pair(0.0, 1e-4)}) {
    const ClockReading reading = read_foreign(5000, there, back);
    NodeClock clock;
    clock.add(reading);
    EXPECT_FALSE(reading.shares_clock());
    EXPECT_NEAR(clock.error(), (there + back) / 2, 1e-9);
    EXPECT_NEAR(clock.to_host(foreign_time(5000 + there)), 5000 + there, clock.error() * 1.000001 + 1e-9);
  }
}

TEST(NodeClock, TwoReadingsTakeTheDriftAway) {
  NodeClock one, two;
  one.add(read_foreign(5000, 1e-6, 1e-6));
  two.add(read_foreign(5000, 1e-6, 1e-6));
  two.add(read_foreign(5600, 1e-6, 1e-6));
  EXPECT_NEAR(one.to_host(foreign_time(5300)), 5300 + 300 * 50e-6, 1e-5) << "drift is there to be corrected";
  EXPECT_NEAR(two.to_host(foreign_time(5300)), 5300, 2e-6);
}

TEST(NodeClock, TheHostsOwnClockIsRecognised) {
  const ClockReading reading = ClockReading::of(5000, 5000.0009, 5000.001);
  EXPECT_TRUE(reading.shares_clock());
  NodeClock clock;
  clock.add(reading);
  EXPECT_EQ(clock.to_host(5001.5), 5001.5);
  EXPECT_EQ(clock.error(), 0);
}

}  // namespace
}  // namespace mars::trace
