#include "host/shell/launch/supervisor.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <deque>
#include <set>

#include "host/content/document/whole_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

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
  remains.last_words = {"what nobody has seen yet"};
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
    bool kept_film;
  };

  Supervisor supervise(std::deque<Remains> jobs) {
    jobs_ = std::move(jobs);
    options_.folder = "out";
    options_.nodes = 8;
    options_.backend = options::Backend::mpi;
    return Supervisor(
        options_,
        {[this](const options::RenderOptions& options, const std::vector<Slots>& machines) {
           starts_.push_back({options.frames.text(), options.nodes, machines, options.overwrite, options.kept_film});
           const Remains next = jobs_.front();
           jobs_.pop_front();
           return next;
         },
         [this](const std::string& run) {
           cleared_.push_back(run);
           return recorded_;
         },
         [this] { return machines_; },
         [this](std::chrono::seconds pause, const std::vector<std::string>&) {
           pauses_.push_back(pause.count());
           if (stops_) throw child::Stopped("stopped by Terminated", "", "");
           return answering_;
         },
         [this](const std::vector<std::uint32_t>& frames) -> std::optional<std::uint32_t> {
           if (!seen_) return std::nullopt;
           return std::ranges::count_if(frames, [this](std::uint32_t frame) { return seen_->contains(frame); });
         },
         [this](const std::string& line) { printed_ += line + "\n"; }, [] { return std::string("advice"); }});
  }

  options::RenderOptions options_;
  std::deque<Remains> jobs_;
  std::vector<Slots> machines_;
  std::set<std::string> answering_;
  std::vector<Start> starts_;
  std::vector<long> pauses_;
  bool stops_ = false;  // a person, in the pause
  std::string printed_;
  std::vector<std::string> cleared_;             // runs
  std::uint32_t recorded_ = 0;                   // frames of such a run
  std::optional<std::set<std::uint32_t>> seen_;  // frames in the folder
};

TEST_F(SupervisorOf, AJobThatEndsWellIsStartedOnce) {
  Supervisor supervisor = supervise({done({0, 1, 2}, 3)});
  supervisor.render();
  EXPECT_EQ(starts_.size(), 1u);
  EXPECT_EQ(starts_[0].frames, "0-");
  EXPECT_EQ(supervisor.restarts(), 0u);
}

// Another start would wait as long for the same machines.
TEST_F(SupervisorOf, MachinesThatDoNotReachEachOtherEndTheRun) {
  Remains waited;
  waited.ended_for = "not all nodes have answered for 120 seconds";
  waited.cut_off = "n1,n2 cannot reach n3 by TCP: packets are dropped, by a firewall?";
  machines_ = {{"n1", 4}, {"n2", 4}, {"n3", 4}};
  answering_ = {"n1", "n2"};
  Supervisor supervisor = supervise({waited});
  const std::string failure = document::failure_of([&] { supervisor.render(); });
  EXPECT_TRUE(failure.starts_with(waited.cut_off + " (open the ports")) << failure;
  EXPECT_EQ(starts_.size(), 1u);
}

// A job that has begun all the same was not kept from it.
TEST_F(SupervisorOf, MachinesThatReachEachOtherInTheEndMayFail) {
  Remains failed = killed(1, 2, {0}, 2);
  failed.cut_off = "n1 cannot reach n2 by TCP: packets are dropped, by a firewall?";
  Supervisor supervisor = supervise({failed, done({1}, 2, 1)});
  supervisor.render();
  EXPECT_EQ(starts_.size(), 2u);
}

// All frames were taken, but what the host records at its end may be missing.
TEST_F(SupervisorOf, AHostThatFailsAfterTheLastFrameIsAFailure) {
  Remains failed = booted({0, 1, 2}, 3, 0);
  failed.ending.code = 1;
  failed.fault = events::Fault{"not a manifest of frames", "out/frames.json", "remove it", {}, {}, ""};
  Supervisor supervisor = supervise({failed});
  EXPECT_EQ(document::failure_of([&] { supervisor.render(); }),
            "out/frames.json: not a manifest of frames (remove it)");
  EXPECT_EQ(starts_.size(), 1u);
}

// Somebody has removed a frame that was there before, and two that the job had rendered.
Remains missing_at_its_end() {
  Remains failed = booted({1, 2, 3}, 4, 1);
  failed.ending.code = 1;
  failed.fault = events::Fault{"frames that were rendered are gone: 0-2", "out", "", {}, {}, "", 3};
  return failed;
}

TEST_F(SupervisorOf, FramesThatAreGoneAtTheEndAreRenderedByAnotherJob) {
  Supervisor supervisor = supervise({missing_at_its_end(), done({0, 1, 2}, 4, 1)});
  supervisor.render();
  EXPECT_EQ(starts_.size(), 2u);
  EXPECT_EQ(printed_,
            "out: frames that were rendered are gone: 0-2\n"
            "starting again (1 of 5) with 8 nodes; 1 of 4 frames are there\n");
  EXPECT_EQ(supervisor.frames().there(), 4u);
}

// Each job renders as many as somebody removes.
TEST_F(SupervisorOf, FramesThatAreGoneAtEveryEndAreGivenUp) {
  options_.restarts = 2;
  Supervisor supervisor = supervise({missing_at_its_end(), missing_at_its_end(), missing_at_its_end()});
  EXPECT_TRUE(document::holds(document::failure_of([&] { supervisor.render(); }),
                              "gone: 0-2; gave up after 2 restarts without a new frame; 1 of 4 frames are there"));
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

// The next job would compile the edit, and nothing would say so.
TEST_F(SupervisorOf, AFilmEditedBeforeAnyJobHasCompiledItIsNotStartedAgain) {
  const test::TemporaryFolder folder;
  options_.film = (folder / "film.json").string();
  document::write_whole_file(options_.film, "{}");
  Remains killed_early = never_began();
  killed_early.ending = {0, 9};
  Supervisor early = supervise({killed_early, done({0, 1}, 2)});
  document::write_whole_file(options_.film, "{ }");
  EXPECT_EQ(document::failure_of([&] { early.render(); }),
            options_.film +
                ": has changed since this command began, and no job has kept it compiled yet (the same command "
                "renders what it is now)");
  EXPECT_EQ(starts_.size(), 1u);
  Remains entered = killed(1, {}, {0}, 2);
  entered.run = "w1";
  Supervisor late = supervise({entered, done({1}, 2, 1)});
  document::write_whole_file(options_.film, "{  }");
  late.render();
  EXPECT_TRUE(starts_.back().kept_film);
}

// However mpirun ends, with however few words.
TEST_F(SupervisorOf, AJobThatDiesWhileItStartsIsStartedAgain) {
  const std::string kNoDaemon = "ORTE was unable to reliably start one or more daemons.";
  const std::string kLostDaemon =
      "ORTE has lost communication with a remote daemon. Remote daemon: [[1,0],2] on node n3";
  const std::vector<std::pair<child::Ending, std::string>> kDeaths = {
      {{137, 0}, "Primary job  terminated normally, but 1 process returned a non-zero exit code."},
      {{139, 0}, "Primary job  terminated normally, but 1 process returned a non-zero exit code."},
      {{134, 0}, "mpirun: Forwarding signal 6 to job"},
      {{143, 0}, ""},
      {{1, 0}, ""},  // mpirun itself by SIGTERM
      {{0, 0}, "ORTE does not know how to route a message to the specified daemon"},
      {{0, SIGBUS}, "[ada:1] Signal: Bus error (7)"},
      {{205, 0}, kLostDaemon},
      {{9, 0}, kNoDaemon},
      {{137, 0}, kNoDaemon},
      {{255, 0}, kNoDaemon},
      {{1, 0}, "Message: connect() to 10.77.0.11:1048 failed Error: Operation now in progress (115)"},
      {{1, 0}, "A process or daemon was unable to complete a TCP connection to another process:"},
      {{1, 0}, "An MPI communication peer process has unexpectedly disconnected. This usually indicates a failure"},
      {{1, 0},
       "A call to mkdir was unable to create the desired directory: Directory: /tmp/ompi.n1.0 Error: File exists"},
      {{1, 0}, "srun: error: n3: task 1: Killed"},
      {{1, 0}, "srun: error: n[2-3]: tasks 1-2: Exited with exit code 143"},
  };
  for (const auto& [ending, words] : kDeaths) {
    starts_.clear();
    Remains dead = never_began();
    dead.ending = ending;
    dead.last_words = words.empty() ? std::deque<std::string>() : std::deque{words};
    supervise({dead, done({0, 1}, 2)}).render();
    EXPECT_EQ(starts_.size(), 2u) << ending.code << " " << words;
  }
}

TEST_F(SupervisorOf, AHostThatReportsADeathOfAnotherIsStartedAgain) {
  Remains lost = never_began();
  lost.ending.code = 137;
  lost.fault = events::Fault{"MPI_Recv failed", "host", "", {}, {}, ""};
  supervise({lost, done({0, 1}, 2)}).render();
  EXPECT_EQ(starts_.size(), 2u);
}

TEST_F(SupervisorOf, AJobThatDoesNotStartForAReasonIsNotStartedAgain) {
  const std::vector<std::pair<int, std::string>> kReasons = {
      {134, "mpirun was unable to find the specified executable file, and therefore did not launch the job."},
      {132, "mpirun was unable to launch the specified application as it could not access or execute an executable:"},
      {1, "There are not enough slots available in the system to satisfy the 9"},
      {127, "ORTE was unable to reliably start one or more daemons."},
      {1, "A call to mkdir was unable to create the desired directory: Directory: /tmp Error: Read-only file system"},
      {1, "srun: error: n3: task 1: Exited with exit code 1"},
      {1, "mars: film.json: line 3: has no camera"},
      {148, "what ended with no signal"},
      {213, "what ended with no signal"},
  };
  for (const auto& [code, words] : kReasons) {
    starts_.clear();
    Remains failed = never_began();
    failed.ending.code = code;
    failed.last_words = {words};
    Supervisor supervisor = supervise({failed});
    EXPECT_NE(document::failure_of([&] { supervisor.render(); }), "") << words;
    EXPECT_EQ(starts_.size(), 1u) << words;
  }
}

// Open MPI says these besides where a rank ends for a reason that it gives, as recorded on several machines.
TEST_F(SupervisorOf, AReasonThatARankGivesIsNoLossThoughConnectionsBreak) {
  for (const char* besides :
       {"An MPI communication peer process has unexpectedly disconnected.",
        "Local host: n3 PID: 2228 Message: connect() to 10.77.0.11:1024 failed Error: Operation now",
        "A process or daemon was unable to complete a TCP connection to another process:",
        "ORTE has lost communication with a remote daemon. Remote daemon: [[1,0],2] on node n3",
        "ORTE was unable to reliably start one or more daemons."}) {
    for (const bool has_booted : {false, true}) {
      Remains reported = has_booted ? booted({}, 3, 0) : never_began();
      reported.ending.code = 255;
      reported.last_words = {besides};
      reported.fault = events::Fault{"is full", "/films", "", {}, {}, ""};
      Remains printed = never_began();
      printed.last_words = {besides, "mars: film.json: line 3: has no camera"};
      for (const Remains& failed : {reported, printed}) {
        starts_.clear();
        Supervisor supervisor = supervise({failed});
        const std::string said = document::failure_of([&] { supervisor.render(); });
        EXPECT_TRUE(document::holds(said, failed.fault ? "/films: is full" : "line 3: has no camera")) << besides;
        EXPECT_EQ(starts_.size(), 1u) << besides;
      }
    }
  }
}

// Those are no reasons of their own.
TEST_F(SupervisorOf, ARankThatLostAnotherIsStartedAgain) {
  for (const char* said : {"mars: node 3: nothing was heard of the host for 30 s (start the rendering again)",
                           "mars: the host: MPI rank 0: MPI_Testsome failed: MPI_ERR_OTHER: known error not in list"}) {
    starts_.clear();
    Remains lost = never_began();
    lost.last_words = {"Message: connect() to 10.77.0.13:1024 failed", said};
    supervise({lost, done({0, 1}, 2)}).render();
    EXPECT_EQ(starts_.size(), 2u) << said;
  }
}

TEST_F(SupervisorOf, BeforeFramesAreCountedItSaysNothingOfThem) {
  Remains dead = never_began();
  dead.ending.code = 137;
  Remains failed = never_began();
  failed.fault = events::Fault{"is no key of a film", "film.json:1: camrea", "did you mean 'camera'?", {}, {}, ""};
  Supervisor supervisor = supervise({dead, failed});
  EXPECT_EQ(document::failure_of([&] { supervisor.render(); }),
            "film.json:1: camrea: is no key of a film (did you mean 'camera'?)");
}

TEST_F(SupervisorOf, AJobThatDiesWhileItStartsEachTimeIsGivenUp) {
  options_.restarts = 2;
  Remains dead = never_began();
  dead.ending.code = 137;
  Supervisor supervisor = supervise({dead, dead, dead});
  EXPECT_TRUE(document::holds(document::failure_of([&] { supervisor.render(); }),
                              "the host or a node was killed by signal 9 (Killed); gave up after 2 restarts"));
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

TEST_F(SupervisorOf, FilesOfWhichTheHostHadNotHeardAreThere) {
  recorded_ = 4;
  Supervisor supervisor = supervise({killed(1, {}, {0, 2}, 5), done({1}, 5, 4)});
  supervisor.render();
  EXPECT_TRUE(document::holds(printed_, "4 of 5 frames are there\n")) << printed_;
  EXPECT_EQ(supervisor.frames().there(), 5u);
}

TEST_F(SupervisorOf, AJobThatDiesAfterItsLastFrameIsNotStartedAgain) {
  supervise({killed(1, {}, {0, 1, 2}, 3)}).render();
  EXPECT_EQ(starts_.size(), 1u);
}

TEST_F(SupervisorOf, AJobThatDiesAfterItsLastFrameIsStartedAgainWhereFramesAreGone) {
  seen_ = {0, 2};
  supervise({killed(1, {}, {0, 1, 2}, 3), done({1}, 3, 2)}).render();
  EXPECT_EQ(starts_.size(), 2u);
  EXPECT_TRUE(document::holds(printed_, "starting again (1 of 5) with 8 nodes; 2 of 3 frames are there\n"));
}

// Somebody removes between two jobs what the first has brought.
TEST_F(SupervisorOf, JobsThatBringWhatWasThereBeforeAreGivenUp) {
  options_.restarts = 2;
  Supervisor supervisor = supervise({killed(1, {}, {0}, 5), killed(1, {}, {1}, 5), killed(1, {}, {0}, 5)});
  EXPECT_TRUE(document::holds(document::failure_of([&] { supervisor.render(); }),
                              "gave up after 2 restarts without a new frame; 1 of 5 frames are there"));
}

TEST_F(SupervisorOf, AStopInThePauseSaysHowFarItCame) {
  stops_ = true;
  Supervisor supervisor = supervise({killed(1, {}, {0}, 5)});
  EXPECT_EQ(document::failure_of([&] { supervisor.render(); }),
            "out: stopped by Terminated before the job was started again; 1 of 5 frames are there (the same command "
            "goes on)");
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
  machines_ = {{"n1", 2}, {"n2", 2}};
  answering_ = {"n2"};
  supervise({killed(0, {}, {0}, 3), done({0, 1, 2}, 3)}).render();
  EXPECT_TRUE(document::holds(printed_, "only 0 of 1 frames are there still: do all machines see the folder out?"));
}

TEST_F(SupervisorOf, FramesThatAreGoneThoughTheHostStaysAreNoMatterOfMachines) {
  supervise({killed(0, {}, {0}, 3), done({0, 1, 2}, 3)}).render();
  EXPECT_TRUE(document::holds(printed_,
                              "only 0 of 1 frames are there still: others were removed from out, or it has another "
                              "film now\n"));
}

TEST_F(SupervisorOf, OnceAJobHasEnteredTheFolderOthersTakeTheFilmThere) {
  Remains killed_early = never_began();
  killed_early.ending = {0, 9};
  Remains entered = killed_early;
  entered.run = "run-1";
  supervise({killed_early, entered, killed(1, {}, {0}, 3), done({1, 2}, 3, 1)}).render();
  ASSERT_EQ(starts_.size(), 4u);
  EXPECT_FALSE(starts_[0].kept_film);
  EXPECT_FALSE(starts_[1].kept_film) << "the folder may have another film yet";
  EXPECT_TRUE(starts_[2].kept_film);
  EXPECT_TRUE(starts_[3].kept_film);
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
