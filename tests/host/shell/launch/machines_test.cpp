#include "host/shell/launch/machines.h"

#include <gtest/gtest.h>

#include "host/shell/launch/between_jobs.h"

namespace mars::launch {
namespace {

const std::vector<Slots> kFour{{"n1", 4}, {"n2", 4}, {"n3", 4}, {"n4", 4}};
const std::set<std::string> kAll{"n1", "n2", "n3", "n4"};

using Names = std::vector<std::string>;

TEST(Machines, AllThatAnswerAreUsedWithTheirShareOfNodes) {
  Machines machines(kFour, 15);
  const auto all = machines.choose(kAll);
  EXPECT_EQ(all.nodes, 15u);
  EXPECT_EQ(all.use, kFour);
  EXPECT_EQ(all.left_out, Names());
  const auto three = machines.choose({"n1", "n2", "n4"});
  EXPECT_EQ(three.nodes, 11u);
  EXPECT_EQ(three.use, (std::vector<Slots>{{"n1", 4}, {"n2", 4}, {"n4", 4}}));
  EXPECT_EQ(three.left_out, Names{"n3"});
  EXPECT_EQ(machines.choose(kAll).nodes, 15u) << "it is back";
}

TEST(Machines, ThereIsANodeWhileAMachineAnswers) {
  EXPECT_EQ(Machines(kFour, 1).choose({"n3"}).nodes, 1u);
  EXPECT_TRUE(Machines(kFour, 1).choose({}).use.empty());
}

TEST(Machines, ALostOneIsLeftOutOnceThoughItAnswers) {
  Machines machines(kFour, 15);
  machines.blame("n2", true, true);
  EXPECT_EQ(machines.choose(kAll).left_out, Names{"n2"});
  EXPECT_EQ(machines.choose(kAll).left_out, Names());
}

// A node of n4 said that it could not reach n2, when n4 was switched off.
TEST(Machines, ALostOneThatAnswersIsUsedWhereAnotherHasCeasedTo) {
  Machines machines(kFour, 15);
  machines.blame("n2", true, true);
  EXPECT_EQ(machines.choose({"n1", "n2", "n3"}).left_out, Names{"n4"});
  machines.blame("n2", true, true);
  EXPECT_EQ(machines.choose({"n1", "n2", "n3"}).left_out, (Names{"n2", "n4"})) << "n4 was gone already";
}

TEST(Machines, OneWithADeadProcessIsLeftOutWhenItHappensAgain) {
  Machines machines(kFour, 15);
  machines.blame("n2", false, true);
  EXPECT_EQ(machines.choose(kAll).left_out, Names());
  machines.blame("n2", false, true);
  EXPECT_EQ(machines.choose(kAll).left_out, Names()) << "frames came";
  machines.blame("n2", false, false);
  EXPECT_EQ(machines.choose(kAll).left_out, Names{"n2"});
}

TEST(Machines, TheOnlyOneIsUsed) {
  Machines machines({{"n1", 4}}, 3);
  machines.blame("n1", true, false);
  EXPECT_EQ(machines.choose({"n1"}).use.size(), 1u);
}

TEST(Machines, ThisOneNeedsNoName) {
  const auto choice = Machines({}, 4).choose({});
  EXPECT_EQ(choice.nodes, 4u);
  EXPECT_TRUE(choice.left_out.empty());
}

TEST(Machines, SlurmsStates) {
  for (const char* state : {"up", "idle", "mixed", "allocated", "draining", "completing"})
    EXPECT_TRUE(usable(state)) << state;
  for (const char* state : {"down", "down*", "idle*", "fail", "unknown", "powering_down"})
    EXPECT_FALSE(usable(state)) << state;
}

TEST(Machines, SlurmTellsPreemption) {
  const std::string line = "   SuspendTime=None SecsPreSuspend=0 PreemptEligibleTime=2026-01-31T11:59:00 ";
  EXPECT_TRUE(tells_preemption(line + "PreemptTime=2026-01-31T12:00:00"));
  EXPECT_FALSE(tells_preemption(line + "PreemptTime=None"));
  EXPECT_FALSE(tells_preemption(line));
}

TEST(BetweenJobs, NobodyIsAskedWhereThereIsNobody) {
  EXPECT_TRUE(wait_and_ask({std::chrono::seconds(0), Question::nobody, {}}, "/usr/bin:/bin").empty());
}

TEST(BetweenJobs, ThisMachineAnswersWithoutSsh) {
  const std::set<std::string> here{"localhost"};
  EXPECT_EQ(wait_and_ask({std::chrono::seconds(0), Question::ssh, {"localhost"}}, "/usr/bin:/bin"), here);
}

}  // namespace
}  // namespace mars::launch
