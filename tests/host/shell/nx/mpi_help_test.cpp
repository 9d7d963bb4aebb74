// Blocks of help as Open MPI 4.1.4 prints them become one line; what programs print stays.
#include "host/shell/nx/mpi_help.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

namespace mars::nx_jobs {
namespace {

const std::string kDashes(74, '-');

std::string block(const std::string& text) { return kDashes + "\n" + text + kDashes + "\n"; }

const std::string kRemarks =
    "[vm:23080] 1 more process has sent help message help-orte-odls-default.txt / execve error\n"
    "[vm:23080] Set MCA parameter \"orte_base_help_aggregate\" to 0 to see all help / error messages\n";
const std::string kDeath =
    block("mpirun noticed that process rank 2 with PID 0 on node vm exited on signal 11 (Segmentation fault).\n");
const std::string kDied = "mars-nx: node 2 died: signal 11 (Segmentation fault)\n";

TEST(MpiHelp, AProgramThatCannotBeStartedIsOneLine) {
  const std::string execve =
      block(
          "Open MPI tried to fork a new process via the \"execve\" system call but\nfailed.  Open MPI checks many "
          "things before\n\n  Local host:        vm\n  Working dir:       /tmp\n  Application name:  ./bad\n  Error: "
          "            ./bad has a bad interpreter on the first line.\n") +
      block(
          "mpirun was unable to start the specified application as it encountered an\nerror:\n\nError code: -125\n"
          "Error name: The specified application failed to start\nNode: vm\n");
  EXPECT_EQ(explained(execve + kRemarks, false),
            "mars-nx: ./bad: cannot be started on machine vm (start it there without mars-nx to see why)\n");
  const std::string missing = block(
      "mpirun was unable to launch the specified application as it could not access\nor execute an executable:\n"
      "\nExecutable: ./none\nNode: n2\n\nwhile attempting to start process rank 0.\n");
  EXPECT_EQ(explained(missing + kRemarks, false),
            "mars-nx: ./none: there is no such program on machine n2 (put it under the same path on every machine, as "
            "on a shared file system)\n");
}

TEST(MpiHelp, ADeathIsSaidAsOfProcesses) {
  const std::string died = "a word of a node\n" +
                           block("Primary job  terminated normally, but 1 process returned\na non-zero exit code.\n") +
                           kDeath;
  EXPECT_EQ(explained(died, false), "a word of a node\n" + kDied);
  EXPECT_EQ(explained(died, true), "a word of a node\nmars-nx: node 1 died: signal 11 (Segmentation fault)\n");
}

TEST(MpiHelp, WhatProgramsAndExitCodesSayIsEnough) {
  EXPECT_EQ(explained("mars-nx: node 0, csend: there is no node 99\n" +
                          block("MPI_ABORT was invoked on rank 0 in communicator MPI_COMM_WORLD\nwith errorcode 1.\n"),
                      false),
            "mars-nx: node 0, csend: there is no node 99\n");
  EXPECT_EQ(explained(block("mpirun detected that one or more processes exited with non-zero status, thus causing\nthe "
                            "job to be terminated.\n"),
                      false),
            "");
}

TEST(MpiHelp, KnownTroubleHasItsRemedy) {
  EXPECT_EQ(explained(block("There are not enough slots available in the system to satisfy the 9\nslots that were "
                            "requested by Open MPI.\n"),
                      false),
            "mars-nx: the allocation has too few slots for the host and the nodes (use fewer --nodes, or ask for one "
            "task more than nodes)\n");
}

TEST(MpiHelp, WordsOfProgramsStay) {
  const std::string dashes = kDashes + "\n", table = block("MPI_Send of mpirun takes 3 us\n");
  std::string much = dashes;
  for (int i = 0; i < 400; ++i) much += "mpirun is what this program is about\n";
  for (const std::string& words : {table + "more\n", block("MPI_COMM_WORLD: 4\nExecutable: ./x\n"),
                                   block("Open MPI says what nobody has heard.\n"), dashes + "an end\n", much,
                                   std::string("a prompt: "), std::string("10 %\r"), std::string(kDashes)})
    EXPECT_EQ(explained(words, false), words);
  EXPECT_EQ(explained(table + kDeath, false), table + kDied) << "a death leaves what is not understood";
  EXPECT_EQ(explained(dashes + "an end\n" + kDeath, false), dashes + "an end\n" + kDied);
  EXPECT_EQ(explained("half a line" + kDeath, false), "half a line" + kDied);
}

// Each piece is as mpirun would write it.
TEST(MpiHelp, MpirunsEndAndWordsAreThoseOfTheRun) {
  const std::string script = "printf 'name? ' >&2; read name; printf %s '" + kDeath + "' >&2; exit $name";
  int input[2];
  ASSERT_EQ(pipe(input), 0);
  dup2(input[0], STDIN_FILENO);
  ASSERT_EQ(write(input[1], "7\n", 2), 2);
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_mpirun({{}, {"/bin/sh", "-c", script}}, false), 7);
  EXPECT_EQ(run_mpirun({{}, {"/bin/sh", "-c", "kill -KILL $$"}}, false), 128 + 9);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "name? " + kDied);
}

}  // namespace
}  // namespace mars::nx_jobs
