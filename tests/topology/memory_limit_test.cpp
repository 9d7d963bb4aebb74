// Limits that made-up /proc and /sys trees give, and that this process sets.
#include "topology/memory_limit.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temporary_folder.h"

namespace mars::topology {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMiB = 1024 * 1024;
constexpr std::uint64_t kGiB = 1024 * kMiB;

class MemoryLimitTest : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << '\n';
  }
  std::uint64_t together() const { return memory_limit(root_.path()).together; }

  const test::TemporaryFolder root_;
};

TEST_F(MemoryLimitTest, NothingThereIsNoLimit) { EXPECT_EQ(together(), 0u); }

TEST_F(MemoryLimitTest, Version2TakesTheLeastOnTheWayUp) {
  write("proc/self/cgroup", "0::/system.slice/slurmd/job_7/step_0");
  write("sys/fs/cgroup/system.slice/slurmd/job_7/step_0/memory.max", "max");
  EXPECT_EQ(together(), 0u);
  write("sys/fs/cgroup/system.slice/slurmd/job_7/memory.max", std::to_string(2 * kGiB));
  EXPECT_EQ(together(), 2 * kGiB);
  write("sys/fs/cgroup/system.slice/memory.max", std::to_string(3 * kGiB));
  EXPECT_EQ(together(), 2 * kGiB);
  write("sys/fs/cgroup/system.slice/slurmd/job_7/step_0/memory.max", std::to_string(kGiB));
  EXPECT_EQ(together(), kGiB);
}

TEST_F(MemoryLimitTest, AContainersMountIsItsOwnRoot) {
  write("proc/self/cgroup", "0::/");
  write("sys/fs/cgroup/memory.max", std::to_string(512 * kMiB));
  EXPECT_EQ(together(), 512 * kMiB);
}

TEST_F(MemoryLimitTest, Version1NamesItsController) {
  write("proc/self/cgroup", "5:cpu,cpuacct:/job\n4:memory:/slurm/job_7\n0::/");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  write("sys/fs/cgroup/memory/slurm/job_7/memory.limit_in_bytes", "9223372036854771712");
  EXPECT_EQ(together(), 0u);
  write("sys/fs/cgroup/memory/slurm/memory.limit_in_bytes", std::to_string(kGiB));
  EXPECT_EQ(together(), kGiB);
}

TEST_F(MemoryLimitTest, OfAContainersPathOnTheMachineOnlyTheMountIsSeen) {
  write("proc/self/cgroup", "4:memory:/docker/0123abc");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", std::to_string(256 * kMiB));
  EXPECT_EQ(together(), 256 * kMiB);
}

// While it lives, this process may have no more.
class Limited {
 public:
  Limited(__rlimit_resource resource, rlim_t bytes) : resource_(resource) {
    getrlimit(resource_, &before_);
    rlimit less = before_;
    less.rlim_cur = bytes;
    EXPECT_EQ(setrlimit(resource_, &less), 0);
  }
  ~Limited() { setrlimit(resource_, &before_); }
  Limited(const Limited&) = delete;
  Limited& operator=(const Limited&) = delete;

 private:
  __rlimit_resource resource_;
  rlimit before_{};
};

TEST_F(MemoryLimitTest, TheProcessMayHaveLimitsOfItsOwn) {
  const rlim_t addresses = process_memory().addresses + 9 * kGiB;
  const Limited most_addresses(RLIMIT_AS, addresses), most_data(RLIMIT_DATA, 7 * kGiB);
  write("proc/self/statm", "9 5 4 1 0 3 0");
  const MemoryLimit limit = memory_limit(root_.path());
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  EXPECT_EQ(limit, (MemoryLimit{0, {addresses, 7 * kGiB}, {9 * page, 3 * page}}));
  EXPECT_EQ(limit.least(), 7 * kGiB);
}

TEST(MemoryShare, IsHalfOfAnEqualPartOfTheLeast) {
  EXPECT_EQ(memory_share(16 * kGiB, {}, 4), 2 * kGiB);
  EXPECT_EQ(memory_share(16 * kGiB, {8 * kGiB, {}, {}}, 4), kGiB);
  EXPECT_EQ(memory_share(16 * kGiB, {64 * kGiB, {}, {}}, 4), 2 * kGiB);
  EXPECT_EQ(memory_share(16 * kGiB, {0, {kGiB}, {}}, 1), kGiB / 2);
  EXPECT_EQ(memory_share(1024 * kGiB, {}, 1), 4 * kGiB);
  EXPECT_EQ(memory_share(16 * kGiB, {0, {8 * kGiB}, {}}, 4), kGiB / 2) << "each process sees the memory of all";
  EXPECT_EQ(memory_share(16 * kGiB, {0, {8 * kGiB}, {}}, 4, 4), kGiB / 2) << "so does one of four threads";
  EXPECT_EQ(memory_share(16 * kGiB, {0, {3 * kGiB}, {2 * kGiB}}, 1), kGiB / 2) << "less what is in use";
  EXPECT_EQ(memory_share(16 * kGiB, {0, {kGiB}, {2 * kGiB}}, 4), kMiB);
  EXPECT_EQ(memory_share(16 * kGiB, {0, {0, kGiB}, {2 * kGiB}}, 4, 2), kGiB / 8) << "addresses in use are no data";
  EXPECT_EQ(memory_share(16 * kGiB, {0, {3 * kGiB, 2 * kGiB}, {2 * kGiB, kGiB}}, 1), kGiB / 4) << "the lesser of both";
  EXPECT_EQ(memory_share(0, {}, 1), kGiB / 2);
  EXPECT_EQ(memory_share(0, {256 * kMiB, {}, {}}, 1), 128 * kMiB);
}

TEST(MemoryLimit, AmountsAreWrittenInGigabytes) {
  EXPECT_EQ(gigabytes(3'250'000'000), "3.2 GB");
  EXPECT_EQ(gigabytes(40'000'000), "0.0 GB");
  EXPECT_EQ(gigabytes(10'000'000'000'000), "10000.0 GB");
}

}  // namespace
}  // namespace mars::topology
