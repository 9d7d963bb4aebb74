// Quotas that made-up /proc and /sys trees give.
#include "topology/processor_limit.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temporary_folder.h"
#include "topology/machine.h"

namespace mars::topology {
namespace {

namespace fs = std::filesystem;

class ProcessorLimitTest : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << '\n';
  }
  int limit() const { return processor_limit(root_.path()); }

  const test::TemporaryFolder root_;
};

TEST_F(ProcessorLimitTest, NothingThereIsNoLimit) { EXPECT_EQ(limit(), 0); }

TEST_F(ProcessorLimitTest, Version2TakesTheLeastOnTheWayUp) {
  write("proc/self/cgroup", "0::/kubepods.slice/pod7/c1");
  write("sys/fs/cgroup/kubepods.slice/pod7/c1/cpu.max", "max 100000");
  EXPECT_EQ(limit(), 0);
  write("sys/fs/cgroup/kubepods.slice/cpu.max", "400000 100000");
  EXPECT_EQ(limit(), 4);
  write("sys/fs/cgroup/kubepods.slice/pod7/cpu.max", "500000 100000");
  EXPECT_EQ(limit(), 4);
  write("sys/fs/cgroup/kubepods.slice/pod7/c1/cpu.max", "300000 100000");
  EXPECT_EQ(limit(), 3);
}

TEST_F(ProcessorLimitTest, PartsOfAProcessorAreRoundedUp) {
  write("proc/self/cgroup", "0::/");
  write("sys/fs/cgroup/cpu.max", "150000 100000");
  EXPECT_EQ(limit(), 2);
  write("sys/fs/cgroup/cpu.max", "200000 100000");
  EXPECT_EQ(limit(), 2);
  write("sys/fs/cgroup/cpu.max", "1000 100000");
  EXPECT_EQ(limit(), 1);
}

TEST_F(ProcessorLimitTest, Version1NamesItsController) {
  write("proc/self/cgroup", "5:cpu,cpuacct:/docker/0123abc\n4:memory:/other\n0::/");
  write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1");
  write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000");
  write("sys/fs/cgroup/memory/other/cpu.cfs_quota_us", "50000");
  write("sys/fs/cgroup/memory/other/cpu.cfs_period_us", "50000");
  EXPECT_EQ(limit(), 0);
  write("sys/fs/cgroup/cpu/docker/0123abc/cpu.cfs_quota_us", "120000");
  write("sys/fs/cgroup/cpu/docker/0123abc/cpu.cfs_period_us", "50000");
  EXPECT_EQ(limit(), 3);
}

TEST_F(ProcessorLimitTest, WhatIsNoQuotaIsNone) {
  write("proc/self/cgroup", "0::/a\nnonsense\n7:cpu");
  for (const char* text : {"", "max", "100000", "0 100000", "100000 0", "-5 100000", "1e3 x"}) {
    write("sys/fs/cgroup/a/cpu.max", text);
    EXPECT_EQ(limit(), 0) << text;
  }
}

TEST(UsableProcessors, AreThoseOfTheMachineThatWeSee) {
  EXPECT_GE(usable_processors(), 1);
  EXPECT_EQ(usable_processors(), Machine::here().processors());
}

}  // namespace
}  // namespace mars::topology
