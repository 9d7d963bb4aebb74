// How many lines of still parts fit, and with how many groups.
#include "node/wire/still_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/node/shape/sample_counts.h"

namespace mars::wire {
namespace {

constexpr std::uint32_t kWidth = 1920, kHeight = 1080;

// A head, S depths, a number and the groups, in whole cache lines.
std::size_t line_bytes(std::size_t samples, std::size_t groups) {
  return (64 + kWidth * (4 * samples + 4 + 16 * groups) + 63) / 64 * 64;
}

TEST(StillPlan, WithOneSampleAllDepthsAreKept) {
  for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{1} << 40}) {
    const StillPlan plan = plan_still_lines(kWidth, kHeight, 1, bytes);
    EXPECT_EQ(plan.line_bytes, kWidth * sizeof(float));
    EXPECT_EQ(plan.lines, kHeight);
    EXPECT_EQ(plan.bytes(), kWidth * kHeight * sizeof(float));
  }
}

TEST(StillPlan, FewerGroupsComeBeforeFewerLines) {
  for (const std::uint32_t samples : {2u, 4u, 8u, 16u})
    for (std::uint32_t groups = samples; groups >= 1; groups /= 2) {
      const StillPlan fits = plan_still_lines(kWidth, kHeight, samples, kHeight * line_bytes(samples, groups));
      EXPECT_EQ(fits.groups_per_column, groups);
      EXPECT_EQ(fits.line_bytes, line_bytes(samples, groups));
      EXPECT_EQ(fits.lines, kHeight);
      const StillPlan less = plan_still_lines(kWidth, kHeight, samples, kHeight * line_bytes(samples, groups) - 1);
      EXPECT_EQ(less.groups_per_column, std::max(groups / 2, 1u));
      EXPECT_EQ(less.lines, groups == 1 ? kHeight - 1 : kHeight);
    }
}

TEST(StillPlan, MoreMemoryNeverKeepsLess) {
  for (const std::uint32_t samples : {2u, 4u, 8u, 16u}) {
    StillPlan before{};
    for (std::uint64_t bytes = 0; bytes < 2 * kHeight * line_bytes(samples, samples); bytes += 1'000'003) {
      const StillPlan plan = plan_still_lines(kWidth, kHeight, samples, bytes);
      ASSERT_LE(plan.bytes(), bytes);
      ASSERT_LE(plan.lines, kHeight);
      ASSERT_GE(plan.lines, before.lines);
      ASSERT_GE(plan.groups_per_column, before.groups_per_column);
      before = plan;
    }
    EXPECT_EQ(before.groups_per_column, samples);
    EXPECT_EQ(plan_still_lines(kWidth, kHeight, samples, 0).lines, 0u);
  }
}

// The smallest and the largest pictures.
TEST(StillPlan, AnyPicture) {
  for (const std::uint32_t samples : shape::kSampleCounts) {
    EXPECT_EQ(plan_still_lines(1, 1, samples, 1 << 10).lines, 1u);
    EXPECT_EQ(plan_still_lines(16384, 16384, samples, std::uint64_t{1} << 40).lines, 16384u);
  }
}

}  // namespace
}  // namespace mars::wire
