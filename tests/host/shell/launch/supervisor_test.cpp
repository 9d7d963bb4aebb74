#include "host/shell/launch/supervisor.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <deque>

#include "tests/host/content/document/failure_of.h"

namespace mars::launch {
namespace {

const events::Booted kBooted{"mpi", 2, {{0, "n1", 1, "", "sse2"}, {1, "n2", 2, "", "sse2"}}};

// A job that finds `there` of the frames and brings `taken`.
Remains booted(std::vector<std::uint32_t> taken, std::uint32_t of, std::uint32_t there) {
  Remains remains;
  remains.run = "run-1";
  if (there > 0) remains.resumed = events::Resumed{there, of, ""};
  remains.program = "mpirun";
  remains.booted = kBooted;
  remains.taken = std::move(taken);
  remains.progress.keyframes = {static_cast<std::uint32_t>(remains.taken.size()), of - there, 1};
  return remains;
}

Remains done(std::vector<std::uint32_t> taken, std::uint32_t of, std::uint32_t there = 0) {
  Remains remains = booted(std::move(taken), of, there);
  remains.done = events::Done{of, 1, "out", 0};
  return remains;
}

// A node is killed while it draws `frame`; none: what it drew is not known.
Remains killed(std::int32_t node, std::optional<std::int32_t> frame, std::vector<std::uint32_t> taken, std::uint32_t of,
               std::uint32_t there = 0) {
  Remains remains = booted(std::move(taken), of, there);
  remains.ending.code = 137;
  const std::string machine = node == 0 ? "n1" : "n2";
  remains.last_words = {"mpirun noticed that process rank " + std::to_string(node + 1) + " with PID 7 on node " +
                        machine + " exited on signal 9 (Killed)."};
  if (frame) remains.drawing = events::Drawing{{{node, *frame}}};
  return remains;
}

Remains never_began() {
  Remains remains;
  remains.program = "mpirun";
  remains.ending.code = 1;
  return remains;
}

// A world of jobs that end as they were written down.
class SupervisorOf : public testing::Test {
 protected:
  struct Start {
    std::string frames;
    std::uint32_t nodes;
    std::vector<Slots> machines;
    bool overwrite;
  };

  Supervisor supervise(std::deque<Remains> jobs) {
    jobs_ = std::move(jobs);
    options_.folder = "out";
    options_.nodes = 8;
    options_.backend = options::Backend::mpi;
    return Supervisor(
        options_, {[this](const options::RenderOptions& options, const std::vector<Slots>& machines) {
                     starts_.push_back({options.frames.text(), options.nodes, machines, options.overwrite});
                     const Remains next = jobs_.front();
                     jobs_.pop_front();
                     return next;
                   },
                   [this](const std::string& run) { cleared_.push_back(run); }, [this] { return machines_; },
                   [this](std::chrono::seconds pause, const std::vector<std::string>&) {
                     pauses_.push_back(pause.count());
                     return answering_;
                   },
                   [this](const std::string& line) { printed_ += line + "\n"; }, [] { return std::string("advice"); }});
  }

  options::RenderOptions options_;
  std::deque<Remains> jobs_;
  std::vector<Slots> machines_;
  std::set<std::string> answering_;
  std::vector<Start> starts_;
  std::vector<long> pauses_;
  std::string printed_;
  std::vector<std::string> cleared_;  // runs
};

TEST_F(SupervisorOf, AJobThatEndsWellIsStartedOnce) {
  Supervisor supervisor = supervise({done({0, 1, 2}, 3)});
  supervisor.render();
  EXPECT_EQ(starts_.size(), 1u);
  EXPECT_EQ(starts_[0].frames, "0-");
  EXPECT_EQ(supervisor.restarts(), 0u);
}

TEST_F(SupervisorOf, AJobThatIsKilledBeforeItBeginsIsStartedAgain) {
  Remains killed_early = never_began();
  killed_early.ending = {0, 9};
  Remains lost_a_node = never_began();
  lost_a_node.last_words = {"mpirun noticed that process rank 1 with PID 7 on node n1 exited on signal 9 (Killed)."};
  Supervisor supervisor = supervise({killed_early, lost_a_node, done({0, 1}, 2)});
  supervisor.render();
  EXPECT_EQ(starts_.size(), 3u);
}

TEST_F(SupervisorOf, AJobThatDiesIsStartedAgainWithWhatIsMissing) {
  Supervisor supervisor = supervise({killed(1, {}, {0, 2}, 5), done({1, 3, 4}, 5, 2)});
  supervisor.render();
  ASSERT_EQ(starts_.size(), 2u);
  EXPECT_EQ(starts_[1].frames, "0-");
  EXPECT_EQ(starts_[1].nodes, 8u);
  EXPECT_EQ(cleared_, std::vector<std::string>{"run-1"});
  EXPECT_EQ(printed_,
            "machine n2: node 1 was killed by signal 9 (Killed)\n"
            "starting again (1 of 5) with 8 nodes; 2 of 5 frames are there\n");
  EXPECT_EQ(supervisor.frames().there(), 5u);
}

TEST_F(SupervisorOf, AJobThatDiesAfterItsLastFrameIsNotStartedAgain) {
  supervise({killed(1, {}, {0, 1, 2}, 3)}).render();
  EXPECT_EQ(starts_.size(), 1u);
}

TEST_F(SupervisorOf, ManyJobsWithFramesAreFollowedByAnother) {
  std::deque<Remains> jobs;
  for (std::uint32_t frame = 0; frame < 20; ++frame) jobs.push_back(killed(1, {}, {frame}, 21, frame));
  jobs.push_back(done({20}, 21, 20));
  supervise(jobs).render();
  EXPECT_EQ(pauses_, std::vector<long>(20, 1));
}

TEST_F(SupervisorOf, WithoutNewFramesItGivesUp) {
  options_.restarts = 2;
  Supervisor supervisor = supervise({killed(1, {}, {0}, 5), killed(0, {}, {}, 5, 1), killed(1, {}, {}, 5, 1)});
  EXPECT_TRUE(document::holds(
      document::failure_of([&] { supervisor.render(); }),
      "machine n2: node 1 was killed by signal 9 (Killed); gave up after 2 restarts without a new frame; "
      "1 of 5 frames are there"));
  EXPECT_EQ(pauses_, (std::vector<long>{1, 2}));
}

TEST_F(SupervisorOf, WhatStartingAgainCannotHelpIsReportedAtOnce) {
  const auto ends_with = [this](const Remains& remains, const std::string& says) {
    Supervisor supervisor = supervise({remains});
    EXPECT_TRUE(document::holds(document::failure_of([&] { supervisor.render(); }), says));
  };
  Remains stopped = killed(1, {}, {}, 5);
  stopped.passed_on = SIGTERM;
  ends_with(stopped, "stopped by Terminated");
  Remains full = booted({0}, 5, 0);
  full.fault = events::Fault{"No space left on device", "out", "", {}, {}, ""};
  ends_with(full, "No space left");
  ends_with(never_began(), "mpirun ended with exit code 1");
  options_.restarts = 0;
  ends_with(killed(1, {}, {}, 5), "was killed by signal 9");
  options_.restarts = 5;
  options_.sink = options::SinkKind::none;
  ends_with(killed(1, {}, {}, 5), "was killed by signal 9");
}

TEST_F(SupervisorOf, ANodesFailureIsNoReasonToGiveUp) {
  Remains failed = booted({0}, 2, 0);
  failed.fault = events::Fault{"hangs", "node 1 on n2", "", 1, 1, ""};
  supervise({failed, done({1}, 2, 1)}).render();
  EXPECT_EQ(starts_.size(), 2u);
}

TEST_F(SupervisorOf, MachinesThatDoNotAnswerAreLeftOutUntilTheyDo) {
  machines_ = {{"n1", 2}, {"n2", 2}, {"n3", 2}, {"n4", 2}};
  answering_ = {"n1", "n3", "n4"};
  supervise({killed(1, {}, {0}, 3), done({1, 2}, 3, 1)}).render();
  EXPECT_EQ(starts_[1].nodes, 6u);
  EXPECT_EQ(starts_[1].machines, (std::vector<Slots>{{"n1", 2}, {"n3", 2}, {"n4", 2}}));
  EXPECT_TRUE(document::holds(printed_, "with 6 nodes on 3 machines, without n2; 1 of 3 frames are there"));
}

TEST_F(SupervisorOf, TheHostMovesWhereItsMachineIsGone) {
  machines_ = {{"n1", 2}, {"n2", 2}};
  answering_ = {"n2"};
  supervise({killed(0, {}, {0}, 3), done({1, 2}, 3, 1)}).render();
  EXPECT_TRUE(document::holds(printed_, "the host runs on n2 now, no more on n1: both must see the folder out"));
}

TEST_F(SupervisorOf, AFolderThatTheNextHostDoesNotSeeIsNamed) {
  supervise({killed(0, {}, {0}, 3), done({0, 1, 2}, 3)}).render();
  EXPECT_TRUE(document::holds(printed_, "only 0 of 1 frames are there still: do all machines see the folder out?"));
}

TEST_F(SupervisorOf, OnlyTheFirstJobOverwrites) {
  options_.overwrite = true;
  supervise({killed(1, {}, {0}, 3), done({1, 2}, 3, 1)}).render();
  EXPECT_TRUE(starts_[0].overwrite);
  EXPECT_FALSE(starts_[1].overwrite);
}

TEST_F(SupervisorOf, WithoutAnyMachineItEnds) {
  machines_ = {{"n1", 2}, {"n2", 2}};
  Supervisor supervisor = supervise({killed(1, {}, {0}, 3)});
  EXPECT_TRUE(document::holds(document::failure_of([&] { supervisor.render(); }),
                              "none of the machines answers: n1, n2; 1 of 3 frames are there"));
}

TEST_F(SupervisorOf, AJobThatNeverBeganIsStartedWithoutTheMachineThatIsGone) {
  machines_ = {{"n1", 2}, {"n2", 2}};
  answering_ = {"n1"};
  supervise({never_began(), done({0, 1, 2}, 3)}).render();
  EXPECT_EQ(starts_[1].frames, "0-");
  EXPECT_EQ(starts_[1].nodes, 4u);
}

TEST_F(SupervisorOf, AFrameThatKillsTwoNodesIsSetAsideAndTriedByItself) {
  Supervisor supervisor =
      supervise({killed(1, 1, {0}, 4), killed(0, 1, {}, 4, 1), done({2, 3}, 3, 1), killed(0, 1, {}, 1), done({1}, 1)});
  supervisor.render();
  EXPECT_EQ(starts_[1].frames, "0-");
  EXPECT_EQ(starts_[2].frames, "0,2-3");
  EXPECT_EQ(starts_[3].frames, "1");
  EXPECT_EQ(starts_[4].frames, "1");
  EXPECT_EQ(supervisor.frames().there(), 4u);
}

TEST_F(SupervisorOf, AFrameThatKillsByItselfIsReportedWhenTheRestIsThere) {
  Supervisor supervisor = supervise(
      {killed(1, 1, {0}, 4), killed(0, 1, {}, 4, 1), done({2, 3}, 3, 1), killed(0, 1, {}, 1), killed(1, 1, {}, 1)});
  EXPECT_TRUE(document::holds(document::failure_of([&] { supervisor.render(); }),
                              "out: the nodes that drew frame 1 were killed each time; 3 of 4 frames are there"));
}

}  // namespace
}  // namespace mars::launch
