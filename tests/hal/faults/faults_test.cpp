// Falls of a node over threads, where it can only throw, and over forked processes.
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstddef>
#include <exception>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/processes/run_processes.h"
#include "hal/threads/run_threads.h"
#include "tests/hal/faults/faults.h"
#include "tests/sanitizers/sanitized.h"

namespace mars::faults {
namespace {

constexpr int kNodes = 4;
constexpr double kSoon = 20;  // also on a machine with much else to do

class OverThreads : public testing::TestWithParam<std::string> {};

TEST_P(OverThreads, AllEnd) {
  const auto rank = [] { run_rank({"throws", GetParam()}); };
  const double begin = dclock();
  std::string reason = "none";
  try {
    threads::run_threads(kNodes, rank, rank);
  } catch (const std::exception& failure) {
    reason = failure.what();
  }
  EXPECT_EQ(reason, "a fault on purpose");
  EXPECT_LT(dclock() - begin, kSoon);
}

INSTANTIATE_TEST_SUITE_P(Faults, OverThreads, testing::ValuesIn(kMoments), [](const auto& info) { return info.param; });

class OverProcesses : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(OverProcesses, AllEnd) {
  const auto rank = [] {
    run_rank({std::get<0>(GetParam()), std::get<1>(GetParam())});
    return 0;
  };
  const double begin = dclock();
  EXPECT_NE(processes::run_processes(kNodes, rank, rank), 0);
  EXPECT_LT(dclock() - begin, kSoon);
  EXPECT_TRUE(waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD) << "a process is left";
}

INSTANTIATE_TEST_SUITE_P(Faults, OverProcesses, testing::Combine(testing::ValuesIn(kWays), testing::ValuesIn(kMoments)),
                         [](const auto& info) { return std::get<0>(info.param) + "_" + std::get<1>(info.param); });

// One node's limit of addresses leaves no room for what the others have: none may go on as if all had it.
TEST(OverProcesses, EndWhereOneNodeAloneCannotShare) {
  if (sanitizers::kSanitized) GTEST_SKIP() << "a sanitizer has taken more addresses than the limit leaves";
  constexpr std::size_t kMany = std::size_t{1} << 30;
  const auto node = [] {
    if (mynode() == 1) {
      const rlimit limit{kMany, kMany};
      setrlimit(RLIMIT_AS, &limit);
    }
    try {
      const messages::SharedMemory shared(kMany);
      gsync();
    } catch (const Failure&) {
      gsync();  // as a caller does that has another way
    }
    return 0;
  };
  EXPECT_NE(processes::run_processes(
                2, [] { return 0; }, node),
            0);
}

}  // namespace
}  // namespace mars::faults
