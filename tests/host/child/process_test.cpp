// Programs and functions as processes: their streams, their ends, and what is left of them.
#include "host/child/process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "host/child/descriptor.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::child {
namespace {

Command shell(const std::string& script) { return {{{"GREETING", "good day"}}, {"/bin/sh", "-c", script}}; }

TEST(Descriptor, TheNullDeviceIsReadAndWritten) {
  const Descriptor nothing = null_device();
  EXPECT_TRUE(write_all(nothing, "x"));
  char byte = 0;
  EXPECT_EQ(read(nothing.number(), &byte, 1), 0);
}

TEST(Process, HasTheStreamsThatItIsGiven) {
  const Descriptor input = file_in_memory("from us"), output = file_in_memory(), errors = file_in_memory();
  // Numbers that are descriptors of ours, too: each stream is still its own.
  const ProcessSetup setup{.streams = {{0, input.number()},
                                       {1, output.number()},
                                       {2, errors.number()},
                                       {input.number(), output.number()},
                                       {output.number(), errors.number()}}};
  const std::string ours = std::to_string(input.number()), other = std::to_string(output.number());
  Process process(shell("cat; echo \" $GREETING\"; echo bad >&2; echo more >&" + ours + "; echo worse >&" + other),
                  setup);
  EXPECT_TRUE(process.wait().well());
  EXPECT_EQ(content_of(output), "from us good day\nmore\n");
  EXPECT_EQ(content_of(errors), "bad\nworse\n");
}

TEST(Process, EndsWithACodeOrASignal) {
  EXPECT_EQ(Process(shell("exit 7"), {}).wait().code, 7);
  EXPECT_EQ(Process(shell("kill -9 $$"), {}).wait().signal, SIGKILL);
  EXPECT_EQ(Process([] { return 5; }, {}).wait().code, 5);
}

TEST(Process, EndsSoAlsoWhereOurParentIgnoresTheEndsOfChildren) {
  std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(Process(shell("exit 7"), {}).wait().code, 7);
  std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(Process([] { return 5; }, {}).wait().code, 5);
  std::signal(SIGCHLD, SIG_DFL);
}

TEST(Process, HasNotEndedWellWhereItsEndIsTaken) {
  Process process(shell("exit 0"), {});
  EXPECT_GT(waitpid(-1, nullptr, 0), 0);
  EXPECT_NE(process.wait().code, 0);
}

TEST(Process, SaysWhyItCannotStart) {
  EXPECT_EQ(document::failure_of([] {
              Process({{}, {"/no/such/program"}}, {});
            }),
            "/no/such/program: cannot be started: No such file or directory");
}

TEST(Process, IsGoneWithItsObject) {
  pid_t id = 0;
  {
    Process process(shell("exec sleep 60"), {.own_group = true});
    id = process.id();
    EXPECT_FALSE(process.poll());
  }
  EXPECT_EQ(kill(id, 0), -1);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no process is left behind";
}

TEST(Process, MayHaveSignalsThatWeIgnore) {
  std::signal(SIGXFSZ, SIG_IGN);
  const auto raised = [] { return raise(SIGXFSZ); };
  EXPECT_TRUE(Process(raised, {}).wait().well());
  EXPECT_EQ(Process(raised, {.default_signals = {SIGXFSZ}}).wait().signal, SIGXFSZ);
  std::signal(SIGXFSZ, SIG_DFL);
}

}  // namespace
}  // namespace mars::child
