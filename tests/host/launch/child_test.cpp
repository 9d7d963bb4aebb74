#include "host/launch/child.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>
#include <vector>

#include "tests/host/document/failure_of.h"

namespace mars::host {
namespace {

using namespace std::chrono_literals;
using Lines = std::vector<std::string>;

struct Outcome {
  Lines output;
  Lines error;
  Ending ending;
  int passed_on = 0;
  double seconds = 0;
};

// `started` is called once the first line has come.
Outcome run(const std::string& script, const std::function<void()>& started = {}) {
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome;
  Child child({{{"GREETING", "good day"}}, {"/bin/sh", "-c", script}});
  outcome.ending = child.wait({[&](const std::string& line) {
                                 outcome.output.push_back(line);
                                 if (started && outcome.output.size() == 1) started();
                               },
                               [&](const std::string& line) { outcome.error.push_back(line); }, [] {}});
  outcome.passed_on = child.passed_on();
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

TEST(Child, BringsBothOutputsAndTheEnd) {
  const Outcome outcome = run("echo one; echo two >&2; printf 'three\\n\\nfour'; exit 7");
  EXPECT_EQ(outcome.output, (Lines{"one", "three", "", "four"}));
  EXPECT_EQ(outcome.error, Lines{"two"});
  EXPECT_EQ(outcome.ending.code, 7);
  EXPECT_EQ(outcome.ending.signal, 0);
}

TEST(Child, HasOurEnvironmentAndMore) {
  EXPECT_EQ(run("echo \"$GREETING\"; test -n \"$PATH\" && cat").output, Lines{"good day"});
}

TEST(Child, MayWriteMuch) {
  const Outcome outcome =
      run("i=0; while [ $i -lt 20000 ]; do echo 0123456789012345678901234567890123456789; "
          "i=$((i+1)); done");
  EXPECT_EQ(outcome.output.size(), 20000u);
}

TEST(Child, KilledIsToldBySignal) { EXPECT_EQ(run("kill -9 $$").ending.signal, SIGKILL); }

TEST(Child, AMissingProgramIsAFailure) {
  EXPECT_EQ(failure_of([] {
              Child({{}, {"/no/such/program"}});
            }),
            "/no/such/program: cannot be started: No such file or directory");
}

TEST(Child, SignalsToUsArePassedOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome outcome =
        run("trap 'echo stopped; exit 3' INT TERM; echo ready; while :; do sleep 0.05; done",
            [&] { kill(getpid(), signal); });
    EXPECT_EQ(outcome.output, (Lines{"ready", "stopped"}));
    EXPECT_EQ(outcome.ending.code, 3);
    EXPECT_EQ(outcome.passed_on, signal);
  }
}

TEST(Child, WhoDoesNotListenIsKilled) {
  const Outcome once =
      run("trap '' TERM; echo ready; while :; do sleep 0.05; done", [] { kill(getpid(), SIGTERM); });
  EXPECT_EQ(once.ending.signal, SIGKILL);
  EXPECT_LT(once.seconds, 12);
}

TEST(Child, ASecondSignalKillsAtOnce) {
  const Outcome outcome = run("trap '' TERM; echo ready; while :; do sleep 0.05; done", [] {
    kill(getpid(), SIGTERM);
    std::thread([] {
      std::this_thread::sleep_for(300ms);
      kill(getpid(), SIGTERM);
    }).detach();
  });
  EXPECT_EQ(outcome.ending.signal, SIGKILL);
  EXPECT_LT(outcome.seconds, 4);
}

// A process in a group of its own, as mpirun starts them, that outlives its parent.
TEST(Child, WhatItLeavesIsKilled) {
  const Outcome outcome = run("setsid sleep 60 & echo $!");
  EXPECT_EQ(outcome.ending.code, 0);
  EXPECT_LT(outcome.seconds, 10);
  std::this_thread::sleep_for(100ms);
  ASSERT_EQ(outcome.output.size(), 1u);
  const std::string state =
      run("grep State /proc/" + outcome.output[0] + "/status").output.empty() ? "gone" : "there";
  EXPECT_EQ(state, "gone");
}

TEST(Child, EndsWithItsOwner) {
  std::string process;
  { Child child({{}, {"/bin/sh", "-c", "exec sleep 60"}}); }
  EXPECT_LT(run("echo").seconds, 5);
}

}  // namespace
}  // namespace mars::host
