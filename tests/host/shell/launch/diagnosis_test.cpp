#include "host/shell/launch/diagnosis.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>

#include "tests/host/content/document/failure_of.h"

namespace mars::launch {
namespace {

Remains failed_with(std::deque<std::string> words) {
  Remains remains;
  remains.ending.code = 1;
  remains.last_words = std::move(words);
  remains.program = "/usr/bin/mpirun";
  return remains;
}

std::string message(const Remains& remains) {
  options::RenderOptions options;
  options.folder = "out";
  return diagnose(remains, options, [] { return std::string("/dev/shm is small"); }).failure.what();
}

TEST(Diagnosis, TheHostsOwnWordComesFirst) {
  Remains remains = failed_with({"mars: something else", "noise"});
  remains.fault = events::Fault{"out of memory", "node 1, frame 3", "use less", 1, 3, "mars render x"};
  EXPECT_EQ(message(remains), "node 1, frame 3: out of memory (use less; to see it again: mars render x)");
  remains.fault->remedy = "";
  EXPECT_EQ(message(remains), "node 1, frame 3: out of memory (to see it again: mars render x)");
}

TEST(Diagnosis, APersonWhoStopsItKnowsWhy) {
  Remains remains = failed_with({"mars: abort", "noise"});
  remains.passed_on = SIGINT;
  remains.progress.keyframes = {2, 3, 1};
  EXPECT_EQ(message(remains), "out: stopped by Interrupt after 2 of 3 frames (the same command goes on)");
  remains.recorded = 3;
  EXPECT_TRUE(document::holds(message(remains), "after 3 of 3 frames")) << "nodes had written more than was reported";
}

TEST(Diagnosis, OfAKilledRank) {
  const auto words = [](const char* rank) {
    Remains remains = failed_with({"Primary job  terminated normally, but 1 process returned", "",
                                   std::string("mpirun noticed that process rank ") + rank +
                                       " with PID 0 on node ada exited on signal 9 (Killed)."});
    remains.booted = events::Booted{"mpi", 1, {{0, "ada", 2, "", "sse2"}, {1, "ada", 1, "", "sse2"}}};
    return remains;
  };
  EXPECT_TRUE(document::holds(message(words("2")), "machine ada: node 0 was killed by signal 9 (Killed)"));
  EXPECT_TRUE(document::holds(message(words("0")), "the host was killed"));
  EXPECT_TRUE(document::holds(message(words("0")), "out of memory"));
}

TEST(Diagnosis, NamesTheMachineThatTheWordsName) {
  EXPECT_TRUE(message(failed_with({"mpirun was unable to find the specified executable file, and therefore",
                                   "did not launch the job.", "", "Node:       n3", "Executable: /opt/mars-node"}))
                  .starts_with("machine n3: there is no program /opt/mars-node that can be run (put them"));
  EXPECT_TRUE(message(failed_with({"[proxy:0:1@n3] HYDU_create_process (launch.c:74): execvp error on file /opt/x"}))
                  .starts_with("machine n3: does not have MARS's programs ("));
  EXPECT_TRUE(message(failed_with({"execvp error on file /opt/x"})).starts_with("a machine does not have"));
  Remains unknown = failed_with({"ssh: Could not resolve hostname n9: Name or service not known",
                                 "ORTE was unable to reliably start one or more daemons."});
  for (const int code : {1, 255}) {
    unknown.ending.code = code;
    EXPECT_TRUE(message(unknown).starts_with("machine n9: Open MPI cannot start there")) << code;
  }
}

// Which machine it was, the doctor says.
TEST(Diagnosis, AsksForTheMachineThatTheWordsDoNotName) {
  EXPECT_TRUE(message(failed_with({"ORTE was unable to reliably start one or more daemons."}))
                  .ends_with("\n/dev/shm is small)"));
}

TEST(Diagnosis, OfALostMachine) {
  EXPECT_EQ(
      message(failed_with({"ORTE has lost communication with a remote daemon.", "",
                           "  HNP daemon   : [[6456,0],0] on node n1", "  Remote daemon: [[6456,0],2] on node n3"})),
      "machine n3: does not answer any more (check whether it still runs and can be reached; "
      "the same command goes on)");
}

// The ssh of a machine's daemon may end before the daemon is missed.
TEST(Diagnosis, OfAMachineWhoseDaemonEndsFirst) {
  Remains remains = failed_with({"ORTE was unable to reliably start one or more daemons.", "",
                                 "  Message:    connect() to 127.0.0.1:1028 failed"});
  EXPECT_TRUE(document::holds(message(remains), "cannot start on another machine")) << "nothing had booted";
  remains.booted =
      events::Booted{"mpi", 2, {{0, "n1", 1, "", "sse2"}, {1, "n4", 2, "", "sse2"}, {2, "n4", 3, "", "sse2"}}};
  EXPECT_TRUE(document::holds(message(remains), "machine n1 or n4: does not answer any more")) << "this one does";
  remains.last_words.push_back("  Message:    connect() to 192.0.2.7:1028 failed");
  EXPECT_TRUE(document::holds(message(remains), "machine 192.0.2.7: does not answer any more"));
  remains.last_words.pop_back();
  remains.last_words.back() = "  Message:    connect() to n4-ib0:1028 failed";
  EXPECT_TRUE(document::holds(message(remains), "machine n4-ib0: does not answer any more")) << "no address";
  remains.last_words.pop_back();
  EXPECT_TRUE(document::holds(message(remains), "machine n1 or n4: does not answer any more"));
}

TEST(Diagnosis, OfABrokenConnection) {
  const Remains remains = failed_with({"An MPI communication peer process has unexpectedly disconnected.  This",
                                       "usually indicates a failure in the peer process", "  Local host: n1",
                                       "  Local PID:  134", "  Peer host:  n2"});
  EXPECT_TRUE(document::holds(message(remains), "machine n2: a connection between processes broke"));
}

// MPI may say very much in between, and in very long words.
TEST(Diagnosis, OfAnyAmountOfWords) {
  const std::string long_word(100000, 'y');
  for (const std::string& noise : {std::string(80, 'y'), long_word, std::string(100000, ' ')}) {
    std::deque<std::string> words{"ORTE has lost communication with a remote daemon.", "=   PID 17078 RUNNING AT ada"};
    words.insert(words.end(), noise.size() > 80 ? 10 : 380, noise);
    EXPECT_TRUE(document::holds(message(failed_with(words)), "a machine was lost"));
    std::deque<std::string> named = words;
    named.push_back("  Remote daemon: [[6456,0],2] on node n3");
    EXPECT_TRUE(document::holds(message(failed_with(named)), "machine n3: does not answer any more"));
    named.back() += long_word;
    EXPECT_LT(message(failed_with(named)).size(), 1000u);
    words.push_back("YOUR APPLICATION TERMINATED WITH THE EXIT STRING: Killed (signal 9)");
    EXPECT_TRUE(document::holds(message(failed_with(words)), "machine ada: the host or a node was killed by signal 9"));
  }
}

TEST(Diagnosis, OfAKilledRankWhoseWordsAreWrapped) {
  Remains remains = failed_with({"process rank x of", "mpirun noticed that process rank 0 with PID 17",
                                 "on node ada exited on", "    signal 11 (Segmentation fault)."});
  EXPECT_TRUE(document::holds(message(remains), "machine ada: the host was killed by signal 11"));
}

TEST(Diagnosis, OfADeathThatTheExitCodeAloneShows) {
  Remains remains = failed_with({"Primary job  terminated normally, but 1 process returned", "a non-zero exit code."});
  remains.ending.code = 128 + SIGKILL;
  EXPECT_TRUE(
      document::holds(message(remains), "the host or a node was killed by signal 9 (Killed) (perhaps the machine"));
  EXPECT_TRUE(document::holds(message(remains), "/dev/shm is small"));
  remains.last_words.push_back("not enough space for");
  EXPECT_TRUE(document::holds(message(remains), "too little shared memory")) << "the cause is known";
}

TEST(Diagnosis, OfADaemonThatDied) {
  Remains remains = failed_with({"ORTE was unable to reliably start one or more daemons."});
  remains.ending.code = SIGKILL;
  EXPECT_TRUE(
      document::holds(message(remains), "Open MPI's daemon on another machine was killed by signal 9 (Killed)"));
  remains = failed_with({"srun: error: n2: task 0: Exited with exit code 1", "srun: error: n3: task 1: Out Of Memory"});
  EXPECT_TRUE(document::holds(message(remains), "machine n3: Open MPI's daemon was killed by signal 9"));
}

TEST(Diagnosis, ShowsTheLastOfManyWords) {
  std::deque<std::string> words(300, "earlier");
  words.push_back("at last");
  const std::string reported = message(failed_with(words));
  EXPECT_TRUE(document::holds(reported, "at last"));
  EXPECT_EQ(std::count(reported.begin(), reported.end(), '\n'), 41) << reported;
}

TEST(Diagnosis, OfAnAllocationThatIsTooSmall) {
  for (const char* words : {"There are not enough slots available in the system to satisfy the 9",
                            "All nodes which are allocated for this job are already filled."}) {
    EXPECT_TRUE(document::holds(message(failed_with({words})), "too few slots for the host and the nodes"));
  }
}

TEST(Diagnosis, OfOurOwnWords) {
  EXPECT_EQ(message(failed_with({"noise", "mars: node 3: this is wrong", "noise"})),
            "node 3: this is wrong (/dev/shm is small)");
}

TEST(Diagnosis, OfWhatIsNotUnderstoodTheLastWords) {
  EXPECT_EQ(message(failed_with({"first", "second"})),
            "mpirun ended with exit code 1 (its last words:\nfirst\nsecond\n/dev/shm is small)");
  Remains booted = failed_with({"first"});
  booted.booted = events::Booted{};
  EXPECT_EQ(message(booted), "mpirun ended with exit code 1 (its last words:\nfirst\n)") << "it could start";
  Remains killed = failed_with({});
  killed.ending = {0, SIGSEGV};
  EXPECT_TRUE(document::holds(message(killed), "mpirun was killed by signal 11 (Segmentation fault)"));
  Remains ended = failed_with({});
  EXPECT_TRUE(document::holds(message(ended), "mpirun ended with exit code 1 and gave no reason"));
  Remains warned = failed_with({"[warn] Epoll MOD(1) on fd 19 failed. Old events were 6: Bad file descriptor"});
  EXPECT_TRUE(document::holds(message(warned), "mpirun ended with exit code 1 and gave no reason"));
  Remains silent = failed_with({});
  silent.ending = {};
  EXPECT_TRUE(document::holds(message(silent), "ended before all frames were there"));
}

}  // namespace
}  // namespace mars::launch
