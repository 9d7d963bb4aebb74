// The rules over forked processes.
#include <gtest/gtest.h>

#include "hal/processes/run_processes.h"
#include "tests/hal/conformance/rules.h"

namespace mars::conformance {
namespace {

class Processes : public testing::TestWithParam<int> {};

TEST_P(Processes, Hold) {
  const auto rank = [] {
    run_rules();
    return 0;
  };
  EXPECT_EQ(processes::run_processes(GetParam(), rank, rank), 0);
}

INSTANTIATE_TEST_SUITE_P(Rules, Processes, testing::Values(1, 2, 3, 4, 7, 8, 16, 32));

}  // namespace
}  // namespace mars::conformance
