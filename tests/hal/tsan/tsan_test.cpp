// The rules and the storms over threads, under the thread sanitizer.
#include <gtest/gtest.h>

#include "hal/threads/run_threads.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/storm/storm.h"

namespace mars::messages {
namespace {

class Tsan : public testing::TestWithParam<int> {};

TEST_P(Tsan, Rules) { threads::run_threads(GetParam(), conformance::run_rules, conformance::run_rules); }

TEST_P(Tsan, Storms) {
  const auto rank = [] {
    storm::run_storm(1);
    storm::run_fresh_storm(static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed)));
  };
  threads::run_threads(GetParam(), rank, rank);
}

INSTANTIATE_TEST_SUITE_P(Threads, Tsan, testing::Values(1, 7));

}  // namespace
}  // namespace mars::messages
