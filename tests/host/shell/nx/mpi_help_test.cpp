// Blocks of help as Open MPI 4.1.4 prints them become one line; what programs print stays.
#include "host/shell/nx/mpi_help.h"

#include <gtest/gtest.h>

#include <sstream>

namespace mars::nx_jobs {
namespace {

const std::string kDashes(74, '-');

std::string block(const std::string& text) { return kDashes + "\n" + text + kDashes + "\n"; }

std::string shown(const std::string& text, bool has_host = false) {
  MpiHelp help(has_host);
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line);) all += help.take(line);
  return all + help.finish();
}

const std::string kRemarks =
    "[vm:23080] 1 more process has sent help message help-orte-odls-default.txt / execve error\n"
    "[vm:23080] Set MCA parameter \"orte_base_help_aggregate\" to 0 to see all help / error messages\n"
    "2 total processes failed to start\n";

TEST(MpiHelp, AProgramThatCannotBeStartedIsOneLine) {
  const std::string execve =
      block(
          "Open MPI tried to fork a new process via the \"execve\" system call but\nfailed.  Open MPI checks many "
          "things before\n\n  Local host:        vm\n  Working dir:       /tmp\n  Application name:  ./bad\n  Error: "
          "            ./bad has a bad interpreter on the first line.\n") +
      block("mpirun was unable to start the specified application as it encountered an\nerror:\n\nError code: -125\n");
  EXPECT_EQ(shown(execve + kRemarks),
            "mars-nx: ./bad: cannot be started on machine vm (start it there without mars-nx to see why)\n");
  const std::string missing = block(
      "mpirun was unable to launch the specified application as it could not access\nor execute an executable:\n"
      "\nExecutable: ./none\nNode: n2\n\nwhile attempting to start process rank 0.\n");
  EXPECT_EQ(shown(missing + kRemarks),
            "mars-nx: ./none: there is no such program on machine n2 (put it under the same path on every machine, as "
            "on a shared file system)\n");
}

TEST(MpiHelp, ADeathIsSaidAsOfProcesses) {
  const std::string died =
      "a word of a node\n" +
      block("Primary job  terminated normally, but 1 process returned\na non-zero exit code.\n") +
      block("mpirun noticed that process rank 2 with PID 0 on node vm exited on signal 11 (Segmentation fault).\n");
  EXPECT_EQ(shown(died), "a word of a node\nmars-nx: node 2 died: signal 11 (Segmentation fault)\n");
  EXPECT_EQ(shown(died, true), "a word of a node\nmars-nx: node 1 died: signal 11 (Segmentation fault)\n");
}

TEST(MpiHelp, WhatProgramsAndExitCodesSayIsEnough) {
  EXPECT_EQ(shown("mars-nx: node 0, csend: there is no node 99\n" +
                  block("MPI_ABORT was invoked on rank 0 in communicator MPI_COMM_WORLD\nwith errorcode 1.\n")),
            "mars-nx: node 0, csend: there is no node 99\n");
  EXPECT_EQ(shown(block("mpirun detected that one or more processes exited with non-zero status, thus causing\nthe "
                        "job to be terminated.\n")),
            "");
}

TEST(MpiHelp, KnownTroubleHasItsRemedy) {
  EXPECT_EQ(shown(block("There are not enough slots available in the system to satisfy the 9\nslots that were "
                        "requested by Open MPI.\n")),
            "mars-nx: the allocation has too few slots for the host and the nodes (use fewer --nodes, or ask for one "
            "task more than nodes)\n");
}

TEST(MpiHelp, OtherWordsStay) {
  const std::string table = block("a program's table\n") + "more\n";
  EXPECT_EQ(shown(table), table);
  const std::string unknown = block("Open MPI says what nobody has heard.\n");
  EXPECT_EQ(shown(unknown), unknown);
  EXPECT_EQ(shown(kDashes + "\nan end\n"), kDashes + "\nan end\n");
  std::string much = kDashes + "\n";
  for (int i = 0; i < 400; ++i) much += "mpirun is what this program is about\n";
  EXPECT_EQ(shown(much), much);
}

}  // namespace
}  // namespace mars::nx_jobs
