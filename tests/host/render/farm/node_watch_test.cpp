// Which nodes are silent and which hang, by a clock that the test moves.
#include "host/render/farm/node_watch.h"

#include <gtest/gtest.h>

namespace mars::farm {
namespace {

using Nodes = std::vector<int>;

// Looks twice a second.
class NodeWatchTest : public testing::Test {
 protected:
  // Nodes of `speaking` beat once a second.
  void pass(int seconds, const Nodes& speaking, const wire::Beat& beat = {.frame = 7, .phase = wire::Phase::sum}) {
    for (int i = 0; i < 2 * seconds; ++i) {
      watch.look(now += 0.5);
      for (const int node : speaking)
        if (i % 2 == 0) watch.hear(node, beat);
    }
  }

  NodeWatch watch{3};
  double now = 1000;
};

TEST_F(NodeWatchTest, NobodyIsSilentAtFirst) {
  watch.look(now);
  EXPECT_EQ(watch.silent(0.1), Nodes());
  EXPECT_EQ(watch.beat(2).frame, -1);
}

TEST_F(NodeWatchTest, ANodeThatSaysNothingIsSilentAndThenHangs) {
  pass(1, {0, 1, 2});
  pass(4, {0, 2});
  EXPECT_EQ(watch.silent(5), Nodes());
  pass(1, {0, 2});
  EXPECT_EQ(watch.silent(5), Nodes({1}));
  EXPECT_EQ(watch.beat(1).frame, 7);
  pass(24, {0, 2});
  EXPECT_EQ(watch.hanging(), Nodes());
  pass(1, {0, 2});
  EXPECT_EQ(watch.hanging(), Nodes({1}));
  watch.hear(1);
  EXPECT_EQ(watch.silent(0.1), Nodes({0, 2})) << "of the last half second";
  EXPECT_EQ(watch.hanging(), Nodes());
}

TEST_F(NodeWatchTest, ANodeThatWaitsForOthersBeatsAndDoesNotHang) {
  pass(600, {0, 2}, {.frame = 7, .phase = wire::Phase::sum, .waits = 1});
  EXPECT_EQ(watch.hanging(), Nodes({1}));
}

TEST_F(NodeWatchTest, ALongStepMayLastTenTimesItsUsualTime) {
  wire::PhaseTimes times{};
  times.depth = 1000;
  for (const double seconds : {2, 6, 1}) {
    times.scanline = seconds;
    watch.note(times);
  }
  watch.hear(0, {.frame = 3, .phase = wire::Phase::scanline});
  watch.hear(1, {.frame = 3, .phase = wire::Phase::depth});
  watch.hear(2, {.frame = -1, .phase = wire::Phase::scanline});
  pass(59, {});
  EXPECT_EQ(watch.hanging(), Nodes({1, 2})) << "one waits in its step, and one draws nothing";
  pass(2, {});
  EXPECT_EQ(watch.hanging(), Nodes({0, 1, 2}));
}

TEST_F(NodeWatchTest, ShadowsMayLastTenTimesTheirUsualTime) {
  wire::PhaseTimes times{};
  times.shadow = 6;
  watch.note(times);
  watch.hear(0, {.frame = 3, .phase = wire::Phase::shadow});
  watch.hear(1, {.frame = 3, .phase = wire::Phase::scanline});
  watch.hear(2, {.frame = 3, .phase = wire::Phase::shadow});
  pass(59, {});
  EXPECT_EQ(watch.hanging(), Nodes({1}));
  pass(2, {});
  EXPECT_EQ(watch.hanging(), Nodes({0, 1, 2}));
}

TEST_F(NodeWatchTest, WhileTheJobIsSuspendedNothingCounts) {
  pass(1, {0, 1, 2});
  for (int times = 0; times < 10; ++times) {
    watch.look(now += 3600);
    pass(2, {0, 1, 2});
  }
  EXPECT_LT(watch.silence(1), 2);
  watch.look(now += 3600);
  EXPECT_LE(watch.silence(1), 2.5) << "a look counts for one second";
}

TEST_F(NodeWatchTest, AClockMayGoBack) {
  pass(2, {});
  watch.look(now - 100);
  EXPECT_GE(watch.silence(0), 1.4);
}

}  // namespace
}  // namespace mars::farm
