// A process that is traced, by its file in /proc.
#include "topology/debugger.h"

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace mars::topology {
namespace {

// A child that waits for its end.
pid_t child(bool traced) {
  const pid_t id = fork();
  if (id != 0) return id;
  if (traced) ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  raise(SIGSTOP);
  _exit(0);
}

bool is_traced_when_stopped(bool traced) {
  const pid_t id = child(traced);
  waitpid(id, nullptr, WUNTRACED);
  const bool found = is_traced(id);
  kill(id, SIGKILL);
  waitpid(id, nullptr, 0);
  return found;
}

TEST(Debugger, HasAProcessThatItTraces) {
  EXPECT_TRUE(is_traced_when_stopped(true));
  EXPECT_FALSE(is_traced_when_stopped(false)) << "a signal stopped it";
}

TEST(Debugger, NobodyTracesAProcessThatIsNotThere) { EXPECT_FALSE(is_traced(1, "/nowhere")); }

}  // namespace
}  // namespace mars::topology
