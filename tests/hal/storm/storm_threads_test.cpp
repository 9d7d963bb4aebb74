// Storms over threads: fixed ones, and a fresh one a run (GTEST_RANDOM_SEED=n runs a certain one instead).
#include <gtest/gtest.h>

#include "hal/threads/run_threads.h"
#include "tests/hal/storm/storm.h"

namespace mars::storm {
namespace {

class Threads : public testing::TestWithParam<int> {};

TEST_P(Threads, KeepTheRules) { threads::run_threads(GetParam(), run_fixed_storms, run_fixed_storms); }

TEST_P(Threads, KeepTheRulesFresh) {
  const auto rank = [] { run_fresh_storm(static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed))); };
  threads::run_threads(GetParam(), rank, rank);
}

INSTANTIATE_TEST_SUITE_P(Storms, Threads, testing::Values(1, 2, 3, 7, 16));

}  // namespace
}  // namespace mars::storm
