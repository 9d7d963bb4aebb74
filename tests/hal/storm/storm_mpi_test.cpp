// Storms over MPI, at as many nodes as the job has (tests/hal/mpi_main.cpp).
#include <gtest/gtest.h>

#include "tests/hal/storm/storm.h"

namespace mars::storm {
namespace {

TEST(Storms, KeepTheRules) { run_fixed_storms(); }

TEST(Storms, KeepTheRulesFresh) { run_fresh_storm(static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed))); }

}  // namespace
}  // namespace mars::storm
