#include "host/shell/launch/job_watch.h"

#include <gtest/gtest.h>

namespace mars::launch {
namespace {

using std::chrono::seconds;
using Clock = JobWatch::Clock;

const Clock::time_point kStart{};

// Looks ten times a second, as the launcher does.
class JobWatches : public testing::Test {
 protected:
  // What is found until `until` seconds after the start.
  JobWatch::Findings look_until(double until) {
    JobWatch::Findings all;
    for (; now_ <= until; now_ += 0.1) {
      const auto found =
          watch_.look(kStart + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(now_)));
      all.lines.insert(all.lines.end(), found.lines.begin(), found.lines.end());
      if (all.end.empty()) all.end = found.end;
    }
    return all;
  }
  void boot() {
    watch_.hear(events::Loading{"film.json"});
    watch_.hear(events::Loaded{1});
    watch_.hear(events::Booted{"mpi", 1, {}});
    watch_.hear(events::Beat{"rendering", {}});
  }

  JobWatch watch_{kStart};
  double now_ = 0;
};

TEST_F(JobWatches, ASilentHostIsNamedAfterTenSecondsAndEndedAfterThirty) {
  boot();
  EXPECT_TRUE(look_until(9.5).lines.empty());
  const auto named = look_until(29.5);
  EXPECT_EQ(named.lines, std::vector<std::string>{"the host has said nothing for 10 seconds; it was rendering"});
  EXPECT_EQ(named.end, "");
  EXPECT_EQ(look_until(30.5).end, "the host has said nothing for 30 seconds; it was rendering");
}

TEST_F(JobWatches, AHostThatIsHeardAgainGoesOn) {
  boot();
  look_until(20);
  watch_.hear(events::Beat{"rendering", {}});
  const auto found = look_until(29);
  EXPECT_EQ(found.lines, std::vector<std::string>{"the host is heard again"});
  EXPECT_EQ(look_until(31).lines.size(), 1u) << "it is silent again";
  EXPECT_EQ(look_until(45).end, "");
}

TEST_F(JobWatches, APauseOfAllIsNoSilence) {
  boot();
  look_until(5);
  now_ += 3600;
  EXPECT_TRUE(look_until(now_ + 1).lines.empty());
}

TEST_F(JobWatches, AHostThatSendsNoBeatsMayBeSilent) {
  watch_.hear(events::Loading{"film.json"});
  watch_.hear(events::Loaded{1});
  watch_.hear(events::Booted{"mpi", 1, {}});
  const auto found = look_until(1000);
  EXPECT_TRUE(found.lines.empty());
  EXPECT_EQ(found.end, "");
}

TEST_F(JobWatches, NodesThatDoNotComeEndIt) {
  EXPECT_EQ(look_until(119).end, "");
  EXPECT_EQ(look_until(121).end, "not all nodes have answered for 120 seconds");
}

TEST_F(JobWatches, NodesAreNotWaitedForWhileTheFilmIsLoaded) {
  watch_.hear(events::Loading{"film.json"});
  EXPECT_EQ(look_until(1000).end, "");
  watch_.hear(events::Loaded{1000});
  EXPECT_EQ(look_until(1119).end, "");
  EXPECT_NE(look_until(1121).end, "");
}

TEST_F(JobWatches, ASilentNodeIsNamedOnceUntilItIsHeardAgain) {
  boot();
  look_until(0.1);
  const auto beat = [](double silent) { return events::Beat{"rendering", {{3, "n2", 12, "scanline", silent}}}; };
  watch_.hear(beat(6));
  EXPECT_TRUE(look_until(1).lines.empty());
  watch_.hear(beat(10.4));
  watch_.hear(beat(12.4));
  EXPECT_EQ(
      look_until(2).lines,
      std::vector<std::string>{"node 3 on n2 has said nothing for 10 seconds; it was drawing frame 12 (scanline)"});
  watch_.hear(events::Beat{"rendering", {}});
  EXPECT_EQ(look_until(3).lines, std::vector<std::string>{"node 3 is heard again"});
}

TEST_F(JobWatches, AJobThatDoesNotEndIsEnded) {
  boot();
  look_until(100.0 / 4);
  watch_.hear(events::Done{});
  EXPECT_EQ(look_until(34.5).end, "");
  EXPECT_EQ(look_until(36).end, "the job has not ended 10 seconds after its last word");
}

}  // namespace
}  // namespace mars::launch
