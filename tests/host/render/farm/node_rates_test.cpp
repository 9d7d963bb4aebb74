// Which nodes are slow, by times that the tests say.
#include "host/render/farm/node_rates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

namespace mars::farm {
namespace {

constexpr double kWork = 1e6;

// Nodes that draw inbetweens one after another, each at its own pace, and the host that sees them come.
class Course {
 public:
  explicit Course(std::vector<double> seconds) : rates(seconds.size()), seconds_(std::move(seconds)) {
    ends_ = seconds_;
  }

  // Each inbetween in its turn until `end`; `own` as NodeRates::came has it, of the time it took.
  void run(double end, double own = 1, double work = kWork) {
    while (true) {
      const auto next = std::min_element(ends_.begin(), ends_.end());
      if (*next > end) return;
      const auto node = static_cast<std::size_t>(next - ends_.begin());
      rates.came(static_cast<int>(node), *next, own * seconds_[node], work);
      *next += seconds_[node] * noise();
    }
  }
  void set(std::size_t node, double seconds) { seconds_[node] = seconds; }

  NodeRates rates;
  std::function<double()> noise = [] { return 1.0; };

 private:
  std::vector<double> seconds_;
  std::vector<double> ends_;
};

TEST(NodeRates, NobodyIsSlowWhereAllAreEven) {
  Course course({0.1, 0.1, 0.1, 0.1});
  course.run(60);
  for (const int node : {0, 1, 2, 3}) EXPECT_EQ(course.rates.slowness(node), 1);
  EXPECT_TRUE(course.rates.take_changed().empty());
  EXPECT_TRUE(course.rates.slow_times().empty());
}

// Single inbetweens take up to eight times as long, as on a busy machine.
TEST(NodeRates, NoiseMakesNobodySlow) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> any(0, 9);
    Course course(std::vector<double>(8, 0.02));
    course.noise = [&] { return any(random) == 0 ? 8.0 : 0.5 + 0.1 * any(random); };
    course.run(120);
    EXPECT_TRUE(course.rates.slow_times().empty()) << "seed " << seed;
  }
}

TEST(NodeRates, ANodeAtHalfSpeedIsSlowWithinSeconds) {
  Course course({0.1, 0.1, 0.2, 0.1});
  course.run(5);
  EXPECT_EQ(course.rates.slowness(2), 1) << "twice may be chance";
  course.run(7);
  EXPECT_NEAR(course.rates.slowness(2), 2, 1e-9);
  EXPECT_EQ(course.rates.take_changed(), std::vector<int>{2});
  EXPECT_TRUE(course.rates.take_changed().empty());
  EXPECT_EQ(course.rates.slowness(0), 1);
}

TEST(NodeRates, OfTwoNodesTheOtherIsUsual) {
  Course course({0.3, 0.1});
  course.run(9);
  EXPECT_NEAR(course.rates.slowness(0), 3, 1e-9);
  EXPECT_EQ(course.rates.slowness(1), 1);
}

TEST(NodeRates, ANodeThatRecoversIsToldAndKept) {
  Course course({0.1, 0.1, 0.4});
  course.run(10);
  EXPECT_GT(course.rates.slowness(2), 1);
  course.set(2, 0.1);
  course.run(13);
  EXPECT_GT(course.rates.slowness(2), 1) << "for a moment";
  course.run(30);
  EXPECT_EQ(course.rates.slowness(2), 1);
  EXPECT_EQ(course.rates.take_changed(), (std::vector<int>{2, 2})) << "slow, and no longer";
  ASSERT_EQ(course.rates.slow_times().size(), 1u);
  const SlowTime time = course.rates.slow_times().front();
  EXPECT_EQ(time.node, 2);
  EXPECT_NEAR(time.slowness, 4, 1e-9) << "at most";
  ASSERT_TRUE(time.end.has_value());
  EXPECT_LT(time.begin, 8.5);
  EXPECT_GT(*time.end, 13);
  EXPECT_LT(*time.end, 21);
}

TEST(NodeRates, WhatStopsAllForAWhileMakesNobodySlow) {
  Course course({0.1, 0.1, 0.1});
  course.run(5);
  course.noise = [stopped = 0]() mutable { return ++stopped <= 3 ? 300.0 : 1.0; };
  course.run(60);
  EXPECT_TRUE(course.rates.slow_times().empty());
}

TEST(NodeRates, ANodesOwnClockDoesNotSeeItsLinkButTheHostDoes) {
  Course course({0.1, 0.1, 0.3});
  course.run(8, 0.01);
  EXPECT_NEAR(course.rates.slowness(2), 3, 1e-9);
}

// Where the host sees inbetweens late and all at once, what nodes say counts.
TEST(NodeRates, InbetweensThatCameTogetherTookTheirTimeAllTheSame) {
  NodeRates rates(2);
  for (int k = 1; k <= 40; ++k) {
    rates.came(0, 4.0, 0.1, kWork);
    rates.came(1, 4.0, 0.3, kWork);
  }
  EXPECT_EQ(rates.slowness(0), 1);
  EXPECT_NEAR(rates.slowness(1), 3, 0.4) << "the first seemed longer";
}

TEST(NodeRates, MoreWorkIsNotSlowness) {
  NodeRates rates(2);
  for (int k = 1; k <= 200; ++k) {
    rates.came(0, 0.1 * k, 0, kWork);
    if (k % 4 == 0) rates.came(1, 0.1 * k, 0, 4 * kWork);
  }
  EXPECT_TRUE(rates.slow_times().empty());
}

// It waited for its portion, or for a keyframe.
TEST(NodeRates, ShadowsAreWork) {
  wire::WorkCounts counts{};
  double before = work_of(counts);
  for (const wire::Work kind : {wire::Work::casting_light, wire::Work::shadow_point, wire::Work::caster,
                                wire::Work::caster_vertex, wire::Work::caster_triangle}) {
    counts.charged[static_cast<std::size_t>(kind)] = 1000;
    EXPECT_GT(work_of(counts), before + 1000);
    before = work_of(counts);
  }
}

TEST(NodeRates, TimeBeforeItCouldBeginDoesNotCount) {
  NodeRates rates(2);
  for (int k = 1; k <= 200; ++k) {
    rates.came(0, 0.1 * k, 0, kWork);
    if (k % 5 != 0) continue;
    rates.ready(1, 0.1 * k - 0.1);
    rates.came(1, 0.1 * k, 0, kWork);
  }
  EXPECT_TRUE(rates.slow_times().empty());
}

TEST(NodeRates, ASlowNodeThatIsPassedOverIsForgotten) {
  Course course({0.1, 0.1, 0.4});
  course.run(10);
  for (int k = 0; k < 31; ++k) course.rates.given(2, false), course.rates.given(0, false);
  EXPECT_FALSE(course.rates.is_forgotten(2));
  course.rates.given(2, false), course.rates.given(0, false);
  EXPECT_TRUE(course.rates.is_forgotten(2));
  EXPECT_FALSE(course.rates.is_forgotten(0)) << "it is not slow";
  course.rates.given(2, true);
  EXPECT_FALSE(course.rates.is_forgotten(2));
}

}  // namespace
}  // namespace mars::farm
