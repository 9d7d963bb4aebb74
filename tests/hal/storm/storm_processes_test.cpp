// Storms over forked processes: fixed ones, and a fresh one a run (GTEST_RANDOM_SEED=n runs a certain one instead).
#include <gtest/gtest.h>

#include "hal/processes/run_processes.h"
#include "tests/hal/storm/storm.h"

namespace mars::storm {
namespace {

class Processes : public testing::TestWithParam<int> {};

TEST_P(Processes, KeepTheRules) {
  const auto rank = [] {
    run_fixed_storms();
    return 0;
  };
  EXPECT_EQ(processes::run_processes(GetParam(), rank, rank), 0);
}

TEST_P(Processes, KeepTheRulesFresh) {
  const auto rank = [] {
    run_fresh_storm(static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed)));
    return 0;
  };
  EXPECT_EQ(processes::run_processes(GetParam(), rank, rank), 0);
}

INSTANTIATE_TEST_SUITE_P(Storms, Processes, testing::Values(1, 2, 3, 7, 16));

}  // namespace
}  // namespace mars::storm
