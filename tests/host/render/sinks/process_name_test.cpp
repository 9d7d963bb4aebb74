#include "host/render/sinks/process_name.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace mars::sinks {
namespace {

TEST(ProcessName, ThisProcessRuns) {
  const ProcessName self = this_process();
  EXPECT_EQ(self.number, getpid());
  EXPECT_GT(self.start, 0u);
  EXPECT_EQ(is_running(self, self), Running::yes);
  EXPECT_EQ(process_name_of(to_json(self)), self);
}

TEST(ProcessName, OneThatCameLaterUnderTheSameNumberIsAnother) {
  const ProcessName self = this_process();
  ProcessName before = self;
  before.start -= 1;
  EXPECT_EQ(is_running(before, self), Running::no);
}

TEST(ProcessName, OfAnotherMachineOrContainerNothingIsKnown) {
  const ProcessName self = this_process();
  ProcessName other = self;
  other.host = "another";
  EXPECT_EQ(is_running(other, self), Running::yes) << "names are for people";
  other.boot = "another";
  EXPECT_EQ(is_running(other, self), Running::unknown);
  other = self;
  other.processes = "pid:[1]";
  EXPECT_EQ(is_running(other, self), Running::unknown);
  EXPECT_EQ(is_running({}, self), Running::unknown);
  EXPECT_EQ(is_running({}, {}), Running::unknown) << "a system that says nothing of itself";
}

TEST(ProcessName, AStoppedProcessRunsAndAKilledOneDoesNot) {
  const ProcessName self = this_process();
  int pipes[2];
  ASSERT_EQ(pipe(pipes), 0);
  const pid_t child = fork();
  if (child == 0) {
    const ProcessName own = this_process();
    const ssize_t sent = write(pipes[1], &own.start, sizeof own.start);
    raise(SIGSTOP);
    _exit(sent < 0);
  }
  ProcessName process = self;
  process.number = child;
  ASSERT_EQ(read(pipes[0], &process.start, sizeof process.start), ssize_t{sizeof process.start});
  waitpid(child, nullptr, WUNTRACED);
  EXPECT_EQ(is_running(process, self), Running::yes);
  kill(child, SIGKILL);
  siginfo_t ended;
  waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);
  EXPECT_EQ(is_running(process, self), Running::no) << "ended, though nobody has waited for it yet";
  waitpid(child, nullptr, 0);
  EXPECT_EQ(is_running(process, self), Running::no);
  close(pipes[0]);
  close(pipes[1]);
}

}  // namespace
}  // namespace mars::sinks
