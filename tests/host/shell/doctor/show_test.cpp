#include "host/shell/doctor/show.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/host/content/document/failure_of.h"

namespace mars::doctor {
namespace {

using State = Finding::State;

const Finding kGood{State::good, "MPI", "Open MPI 4.1.4", ""};
const Finding kOther{State::note, "MPI", "Open MPI 5.0.3", "see below"};
const Finding kSmall{State::trouble, "/dev/shm", "64 MiB", "enlarge it"};

TEST(HostList, NamesRangesOnce) {
  EXPECT_EQ(host_list({"n1", "n2", "n3", "n4"}), "n1-n4");
  EXPECT_EQ(host_list({"n10", "n9", "n2", "n1", "n9"}), "n1,n2,n9,n10");
  EXPECT_EQ(host_list({"n9", "n10", "n11"}), "n9-n11");
  EXPECT_EQ(host_list({"node08", "node09", "node10", "login"}), "login,node08-node10");
  EXPECT_EQ(host_list({"a", "b", "c1", "d2"}), "a,b,c1,d2");
  EXPECT_EQ(host_list({}), "");
}

TEST(Grouped, WhatIsEqualIsToldOnce) {
  const std::vector<MachineFindings> machines{{"n1", {kGood, kSmall}}, {"n2", {kGood, kSmall}}};
  EXPECT_EQ(grouped(machines), (std::vector<Finding>{kGood, kSmall}));
}

TEST(Grouped, WhoDiffersIsNamed) {
  const std::vector<MachineFindings> machines{
      {"n1", {kGood}}, {"n2", {kGood}}, {"n3", {kOther, kSmall}}, {"n4", {kGood}}};
  EXPECT_EQ(grouped(machines), (std::vector<Finding>{{State::good, "MPI", "n1,n2,n4: Open MPI 4.1.4", ""},
                                                     {State::note, "MPI", "n3: Open MPI 5.0.3", "see below"},
                                                     {State::trouble, "/dev/shm", "n3: 64 MiB", "enlarge it"}}));
}

TEST(Lines, TravelWhole) {
  const MachineFindings one{"n1", {kGood, {State::note, "TMPDIR", "/tmp/\"a b\"\n", "\xff"}}};
  std::istringstream lines(lines_of(one) + lines_of({"n2", {kSmall}}));
  std::vector<MachineFindings> machines;
  for (std::string line; std::getline(lines, line);) EXPECT_TRUE(add_line(line, machines)) << line;
  ASSERT_EQ(machines.size(), 2u);
  EXPECT_EQ(machines[0].findings[0], kGood);
  EXPECT_EQ(machines[0].findings[1].found, "/tmp/\"a b\"\n");
  EXPECT_EQ(machines[1], (MachineFindings{"n2", {kSmall}}));
  for (const char* other : {"", "srun: job 7 queued", "{}", "[1]", "7"}) EXPECT_FALSE(add_line(other, machines));
}

TEST(Text, OneLineEachAndWhatToDoBelow) {
  const std::vector<Finding> findings{kGood, kSmall};
  EXPECT_EQ(text_of(findings),
            "  ok       MPI         Open MPI 4.1.4\n"
            "  TROUBLE  /dev/shm    64 MiB\n"
            "                       -> enlarge it\n");
  EXPECT_TRUE(in_trouble(findings));
  EXPECT_TRUE(document::holds(verdict(findings), "1 trouble"));
  EXPECT_FALSE(in_trouble(std::vector<Finding>{kGood, kOther}));
  EXPECT_TRUE(document::holds(verdict(std::vector<Finding>{kOther}), "No trouble found"));
}

TEST(Text, FitsATerminal) {
  std::string words;
  for (int i = 0; i < 60; ++i) words += "word ";
  std::istringstream lines(text_of(std::vector<Finding>{{State::note, "memory", words, words}}));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_GT(count, 8);
}

TEST(Text, AdviceIsOnlyOfTroubles) {
  EXPECT_EQ(short_text(std::vector<Finding>{kGood, kOther, kSmall}),
            "/dev/shm: 64 MiB (enlarge it)\nfor more run mars doctor");
  EXPECT_EQ(short_text({}), "for more run mars doctor");
}

TEST(Placement, TellsCoresAndWhatTheyShare) {
  const auto machine = topology::Machine::synthetic("pack:2 numa:1 l3:1 core:4 pu:1");
  EXPECT_EQ(placement_text(machine, 4, 0),
            "Nodes by core, as mars render places them on this machine:\n"
            "  0:  cores 0-1      1:  cores 2-3      2:  cores 4-5      3:  cores 6-7\n"
            "  across dimension 0 neighbours share an L3 cache\n"
            "  across dimension 1 neighbours share the machine\n");
  EXPECT_TRUE(document::holds(placement_text(machine, 9, 1), "9 nodes on 8 cores: none is bound"));
}

}  // namespace
}  // namespace mars::doctor
