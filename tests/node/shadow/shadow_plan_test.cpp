#include "node/shadow/shadow_plan.h"

#include <gtest/gtest.h>

#include "node/shadow/casters.h"
#include "node/shadow/pairs.h"

namespace mars::shadow {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;
constexpr ShadowNeeds kSmall{64, 1, 1, 10}, kLarge{3840, 16, 3, 1'000'000};

TEST(ShadowPlan, IsNothingWithoutCastingLights) {
  EXPECT_EQ(plan_shadows({1920, 4, 0, 100}, 1024 * kMiB).bytes(), 0u);
  EXPECT_EQ(least_shadow_bytes({1920, 4, 0, 100}), 0u);
}

TEST(ShadowPlan, TakesNoMoreThanThereIs) {
  for (const ShadowNeeds& needs : {kSmall, kLarge})
    for (const std::size_t bytes : {100 * kMiB, 160 * kMiB}) {
      EXPECT_LE(plan_shadows(needs, bytes).bytes(), bytes);
      EXPECT_GT(plan_shadows(needs, bytes).bytes(), bytes - 100) << "all that is of use";
    }
}

TEST(ShadowPlan, HasALeastAndAMost) {
  for (const ShadowNeeds& needs : {kSmall, kLarge}) {
    EXPECT_EQ(plan_shadows(needs, 1).bytes(), least_shadow_bytes(needs));
    EXPECT_EQ(plan_shadows(needs, 1 << 30).bytes(), most_shadow_bytes(needs));
  }
  EXPECT_LT(least_shadow_bytes(kSmall), 11 * kMiB);
  EXPECT_LT(least_shadow_bytes(kLarge), 80 * kMiB);
}

// Two lines, whatever they show; a row of squares; a caster, however finely it is diced.
TEST(ShadowPlan, OfTheLeastMemoryDoes) {
  for (const ShadowNeeds& needs : {kSmall, kLarge}) {
    const ShadowPlan plan = plan_shadows(needs, 0);
    EXPECT_EQ(plan.band, 2 * band_bytes_of_line(needs));
    EXPECT_EQ(lines_of_points(needs, plan.points), kTile);
    EXPECT_TRUE(CasterStore(plan.chunk).has_room());
    EXPECT_EQ(plan.diced, 0u);
  }
}

TEST(ShadowPlan, OfMoreMemoryHasMoreOfEachKind) {
  const ShadowPlan less = plan_shadows(kLarge, 80 * kMiB), more = plan_shadows(kLarge, 120 * kMiB);
  for (const auto kind : {&ShadowPlan::band, &ShadowPlan::points, &ShadowPlan::chunk, &ShadowPlan::diced})
    EXPECT_LT(less.*kind, more.*kind);
  EXPECT_EQ(less.fixed, more.fixed);
}

}  // namespace
}  // namespace mars::shadow
