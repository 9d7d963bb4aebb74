// The rules over threads.
#include <gtest/gtest.h>

#include "hal/threads/run_threads.h"
#include "tests/hal/conformance/rules.h"

namespace mars::conformance {
namespace {

class Threads : public testing::TestWithParam<int> {};

TEST_P(Threads, Hold) { threads::run_threads(GetParam(), run_rules, run_rules); }

INSTANTIATE_TEST_SUITE_P(Rules, Threads, testing::Values(1, 2, 3, 4, 7, 8, 16, 32));

}  // namespace
}  // namespace mars::conformance
