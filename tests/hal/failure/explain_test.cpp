// The Failures that stand for other exceptions.
#include "hal/failure/explain.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <exception>
#include <new>

#include "tests/sanitizers/sanitized.h"

namespace mars {
namespace {

TEST(Explain, NamesTheLimitThatMemoryRanOutOf) {
  if (sanitizers::kSanitized) GTEST_SKIP() << "a sanitizer has taken more than the limit leaves";
  rlimit before{};
  getrlimit(RLIMIT_DATA, &before);
  const rlimit less{rlim_t{8} << 30, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &less), 0);
  const Failure failure = explain(std::bad_alloc());
  setrlimit(RLIMIT_DATA, &before);
  EXPECT_EQ(failure.problem, "there is no more memory to be had within the limit of ulimit -d 8388608");
  EXPECT_EQ(failure.remedy, "raise the limit, use fewer nodes, or set MARS_MEMORY to fewer MiB");
}

TEST(Explain, KnowsABrokenRule) {
  try {
    check(false, "two is one");
    FAIL() << "a broken rule throws";
  } catch (const std::exception& failure) {
    EXPECT_EQ(explain(failure).problem.find("a rule of MARS itself is broken: two is one ("), 0u);
  }
}

}  // namespace
}  // namespace mars
