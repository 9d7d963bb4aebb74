#include "host/child/child.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include "tests/host/content/document/failure_of.h"

namespace mars::child {
namespace {

using namespace std::chrono_literals;
using Lines = std::vector<std::string>;

constexpr double kSoon = 100;  // seconds, on a busy machine too: children that nobody ends sleep for 1000
constexpr double kGrace = 6;   // seconds from a signal to the kill, as in child.cpp

// A signal that came leaves an alarm behind, which would end the tests.
struct ChildTest : testing::Test {
  void TearDown() override { alarm(0); }
};

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

TEST(Child, IsStoppedWhenItsTimeIsOver) {
  const auto late = [](const std::string& script, std::chrono::milliseconds longest) {
    Child child({{}, {"/bin/sh", "-c", script}});
    const TimedEnding timed = wait_at_most(
        child, longest, [](const std::string&) {}, [](const std::string&) {});
    EXPECT_EQ(timed.late, timed.ending.signal == SIGTERM);
    return timed.late;
  };
  EXPECT_TRUE(late("exec sleep 300", std::chrono::milliseconds(100)));
  EXPECT_FALSE(late("exit 3", std::chrono::minutes(5)));
}

TEST(Child, AMissingProgramIsAFailure) {
  EXPECT_EQ(document::failure_of([] {
              Child({{}, {"/no/such/program"}});
            }),
            "/no/such/program: cannot be started: No such file or directory");
}

TEST_F(ChildTest, SignalsToUsArePassedOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome outcome = run("trap 'echo stopped; exit 3' INT TERM; echo ready; while :; do sleep 0.05; done",
                                [&] { kill(getpid(), signal); });
    EXPECT_EQ(outcome.output, (Lines{"ready", "stopped"}));
    EXPECT_EQ(outcome.ending.code, 3);
    EXPECT_EQ(outcome.passed_on, signal);
  }
}

TEST_F(ChildTest, WhoDoesNotListenIsKilled) {
  const Outcome once = run("trap '' TERM; echo ready; while :; do sleep 0.05; done", [] { kill(getpid(), SIGTERM); });
  EXPECT_EQ(once.ending.signal, SIGKILL);
  EXPECT_LT(once.seconds, kSoon);
}

// A start takes a while on a busy machine. A second signal kills, as it does later.
TEST_F(ChildTest, SignalsThatComeBeforeTheProgramRunsArePassedOn) {
  for (const int count : {1, 2}) {
    SignalRelay relay;
    for (int i = 0; i < count; ++i) raise(SIGTERM);
    Process process(Command{{}, {"/bin/sleep", "1000"}}, {.own_group = true, .default_signals = {SIGTERM}});
    relay.relay_to(process.id());
    EXPECT_EQ(process.wait().signal, count == 1 ? SIGTERM : SIGKILL);
    EXPECT_EQ(relay.first(), SIGTERM);
    EXPECT_EQ(relay.count(), count);
  }
}

TEST_F(ChildTest, AProcessOfOurGroupGetsWhatIsSentToUs) {
  SignalRelay relay;
  Process process(Command{{}, {"/bin/sleep", "1000"}}, {.default_signals = {SIGTERM}});
  relay.relay_to_member(process.id());
  raise(SIGTERM);
  EXPECT_EQ(process.wait().signal, SIGTERM);
}

Outcome run_until_a_second_signal() {
  return run("trap '' TERM; echo ready; while :; do sleep 0.05; done", [] {
    kill(getpid(), SIGTERM);
    std::thread([] {
      std::this_thread::sleep_for(300ms);
      kill(getpid(), SIGTERM);
    }).detach();
  });
}

// As between two jobs: the next child ends by the signal that came before it.
TEST_F(ChildTest, ASignalBetweenChildrenEndsTheNext) {
  const SignalRelay signals;
  EXPECT_EQ(run("echo").ending.code, 0);
  kill(getpid(), SIGTERM);
  EXPECT_EQ(signals.first(), SIGTERM);
  const Outcome next = run("sleep 1000");
  EXPECT_EQ(next.ending.signal, SIGTERM);
  EXPECT_LT(next.seconds, kSoon);
  alarm(0);
}

// A busy machine may take as long as the grace once, but not each time.
TEST_F(ChildTest, ASecondSignalKillsAtOnce) {
  double least = 2 * kGrace;
  for (int tries = 0; tries < 10 && least >= kGrace; ++tries) {
    alarm(0);  // of the try before
    const Outcome outcome = run_until_a_second_signal();
    EXPECT_EQ(outcome.ending.signal, SIGKILL);
    least = std::min(least, outcome.seconds);
  }
  EXPECT_LT(least, kGrace);
}

// As a stopped mpirun: it does not even hear the signal that ends it.
TEST_F(ChildTest, WhatIsStoppedIsEnded) {
  const Outcome outcome = run("echo ready; kill -STOP $$; sleep 1000", [] { kill(getpid(), SIGTERM); });
  EXPECT_EQ(outcome.ending.signal, SIGTERM) << "not the signal that comes after the grace";
}

// A child that ignores the signal and has ended its output is waited for no longer than others.
TEST_F(ChildTest, SignalsCountOnceTheOutputHasEnded) {
  const Outcome outcome = run("echo ready; exec >/dev/null 2>&1; exec sleep 1000", [] { kill(getpid(), SIGINT); });
  EXPECT_EQ(outcome.ending.signal, SIGINT);
  EXPECT_LT(outcome.seconds, kSoon);
}

// A listener that hangs, as one that writes where nobody reads: the alarm ends us. In a process of its own.
TEST_F(ChildTest, ASignalEndsUsWhateverWeDo) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EXIT(
      {
        run("echo ready; trap '' TERM; sleep 1000", [] {
          kill(getpid(), SIGTERM);
          kill(getpid(), SIGTERM);
          for (;;) std::this_thread::sleep_for(1h);
        });
      },
      testing::ExitedWithCode(1), "");
  EXPECT_LT(std::chrono::steady_clock::now() - start, SignalRelay::kLongest) << "sooner than by one signal";
}

TEST_F(ChildTest, AnIgnoredHangupStaysIgnored) {
  std::signal(SIGHUP, SIG_IGN);
  const Outcome outcome = run("echo ready; sleep 0.3; exit 5", [] { kill(getpid(), SIGHUP); });
  std::signal(SIGHUP, SIG_DFL);
  EXPECT_EQ(outcome.ending.code, 5);
  EXPECT_EQ(outcome.passed_on, 0);
}

TEST(Child, TheOneWhoStartedUsMayIgnoreOurChildren) {
  std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run("exit 4").ending.code, 4);
}

// Others' ends are left to those who wait for them.
TEST(Child, WaitsForNoOtherChild) {
  const pid_t other = fork();
  if (other == 0) _exit(9);
  EXPECT_EQ(run("sleep 0.2; exit 3").ending.code, 3);
  int status = 0;
  ASSERT_EQ(waitpid(other, &status, 0), other);
  EXPECT_EQ(WEXITSTATUS(status), 9);
}

TEST(Child, KillsNoOtherChild) {
  const pid_t other = fork();
  if (other == 0) {
    std::this_thread::sleep_for(1000s);
    _exit(9);
  }
  run("setsid sleep 1000 &");
  EXPECT_EQ(waitpid(other, nullptr, WNOHANG), 0) << "it should still run";
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
}

TEST(Child, ListenersStartNone) {
  EXPECT_THROW(run("echo ready", [] { run("echo"); }), std::logic_error);
  EXPECT_EQ(run("echo again").output, Lines{"again"});
}

TEST(Child, MayWriteALineWithoutEnd) {
  const Outcome outcome = run("head -c 40000000 /dev/zero | tr '\\0' x");
  EXPECT_GT(outcome.output.size(), 1u);
  std::size_t bytes = 0;
  for (const std::string& piece : outcome.output) bytes += piece.size();
  EXPECT_EQ(bytes, 40000000u);
}

// A process in a group of its own, as mpirun starts them, that outlives its parent.
TEST(Child, WhatItLeavesIsKilled) {
  const Outcome outcome = run("setsid sleep 1000 & echo $!");
  EXPECT_EQ(outcome.ending.code, 0);
  EXPECT_LT(outcome.seconds, kSoon);
  std::this_thread::sleep_for(100ms);
  ASSERT_EQ(outcome.output.size(), 1u);
  const std::string state = run("grep State /proc/" + outcome.output[0] + "/status").output.empty() ? "gone" : "there";
  EXPECT_EQ(state, "gone");
}

TEST(Child, EndsWithItsOwner) {
  std::string process;
  { Child child({{}, {"/bin/sh", "-c", "exec sleep 1000"}}); }
  EXPECT_LT(run("echo").seconds, kSoon);
}

}  // namespace
}  // namespace mars::child
