// Jobs that cannot go on end at once, on all ranks, with the reason printed once and an exit code.
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <chrono>
#include <string>

#include <gtest/gtest.h>

namespace mars::messages {
namespace {

constexpr double kSoon = 200;  // seconds, with the start of mpirun on a busy machine

struct Outcome {
  int code;
  std::string output;
  double seconds;
};

Outcome run(const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  char line[1000];
  while (fgets(line, sizeof line, pipe) != nullptr) output += line;
  const int status = pclose(pipe);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output, time.count()};
}

Outcome run_job(const std::string& arguments) { return run(MPIEXEC " " + arguments + " 2>&1"); }

Outcome run_ranks(int ranks, const std::string& how) {
  return run_job(std::to_string(ranks) + " " FAULTY_JOB " " + how);
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

void expect_fault(const Outcome& outcome, const std::string& reason) {
  EXPECT_NE(outcome.code, 0);
  EXPECT_EQ(count(outcome.output, reason), 1) << outcome.output;
  EXPECT_LT(outcome.seconds, kSoon);
}

const std::string kNeed = "one host and at least one node is needed, and this one has ";

TEST(MpiFaults, NoHost) { expect_fault(run_ranks(3, "node"), kNeed + "0 hosts and 3 nodes"); }
TEST(MpiFaults, TwoHosts) {
  expect_fault(run_job("2 " FAULTY_JOB " host : -n 2 " FAULTY_JOB " node"), kNeed + "2 hosts and 2 nodes");
}
TEST(MpiFaults, NoNode) { expect_fault(run_ranks(1, "host"), kNeed + "1 hosts and 0 nodes"); }
TEST(MpiFaults, NoNodeByRank) { expect_fault(run_ranks(1, "node_throws"), kNeed + "1 hosts and 0 nodes"); }

TEST(MpiFaults, HostMayBeAnyRank) {
  for (const std::string job :
       {"1 " FAULTY_JOB " host : -n 3 " FAULTY_JOB " node", "2 " FAULTY_JOB " node : -n 1 " FAULTY_JOB " host"}) {
    const Outcome outcome = run_job(job);
    EXPECT_EQ(outcome.code, 0) << outcome.output;
  }
}

TEST(MpiFaults, ANodeThrows) { expect_fault(run_ranks(4, "node_throws"), "mars: node 1: a fault on purpose"); }
TEST(MpiFaults, ANodeThrowsSharingMemory) {
  expect_fault(run_ranks(4, "node_throws_sharing_memory"), "mars: node 1: a fault on purpose");
}
TEST(MpiFaults, TheHostThrows) { expect_fault(run_ranks(4, "host_throws"), "mars: the host: a fault on purpose"); }
TEST(MpiFaults, AMessageIsTooLong) {
  expect_fault(run_ranks(3, "message_too_long"),
               "mars: node 1, crecv: a message of 200 bytes, type 1, from node 0 does not fit a receive of 100 bytes");
}
TEST(MpiFaults, TheMachineCannotShareThatMuch) {
  const Outcome outcome = run_ranks(3, "too_much_shared_memory");
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.output.find("cannot share 1125899906842624 bytes"), std::string::npos) << outcome.output;
}

// Each node in a user namespace of its own: none may look at another.
TEST(MpiFaults, NodesThatAreKeptApartShareNoMemory) {
  if (system("unshare --user --map-root-user true 2> /dev/null") != 0) GTEST_SKIP() << "no user namespaces here";
  const std::string job = FAULTY_JOB " apart : -n 3 unshare --user --map-root-user " FAULTY_JOB " apart";
  const Outcome outcome = run_job("1 " + job);
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_LT(outcome.seconds, kSoon);
}

// MPI's own messages go by TCP then, which MPICH does not do within a machine.
TEST(MpiFaults, NodesShareMoreThanDevShmHas) {
  for (const char* mpich : {"mpich", "hydra"})
    if (std::string(MPIEXEC).find(mpich) != std::string::npos) GTEST_SKIP() << "MPICH needs /dev/shm itself";
  const std::string small =
      "unshare --mount sh -c 'mount -t tmpfs -o size=1m tmpfs /dev/shm && OMPI_MCA_btl=self,tcp exec ";
  if (system((small + "true' 2> /dev/null").c_str()) != 0) GTEST_SKIP() << "no mount namespaces here";
  const Outcome outcome = run(small + MPIEXEC " 4 " FAULTY_JOB " fills_shared_memory' 2>&1");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_LT(outcome.seconds, kSoon);
}

TEST(MpiFaults, MessagesThatNobodyReceivesDoNotHinderTheEnd) {
  const Outcome outcome = run_ranks(4, "leaves_messages");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_LT(outcome.seconds, kSoon);
}

TEST(MpiFaults, ANodeThrowsInItsMidst) {
  for (const std::string moment : {"handler", "sending"}) {
    SCOPED_TRACE(moment);
    expect_fault(run_ranks(5, "throws " + moment), "node 1: a fault on purpose");
  }
}

TEST(MpiFaults, ANodeDiesInItsMidst) {
  for (const std::string how : {"killed collective", "exits waiting"}) {
    SCOPED_TRACE(how);
    const Outcome outcome = run_ranks(5, how);
    EXPECT_NE(outcome.code, 0);
    EXPECT_LT(outcome.seconds, kSoon);
  }
}

}  // namespace
}  // namespace mars::messages
