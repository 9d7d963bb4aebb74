// A node's memory is for its frames, but for what inbetweens need of still parts where pixels have several samples.
#include "host/render/farm/node_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "hal/failure/failure.h"

namespace mars::farm {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

wire::FilmSettings film(std::uint32_t samples) {
  wire::FilmSettings settings{};
  settings.width = 1920;
  settings.height = 1080;
  settings.samples = samples;
  return settings;
}

TEST(NodeMemory, WithOneSampleAllIsForFrames) {
  for (const std::optional<std::uint64_t> still : {std::optional<std::uint64_t>(), std::optional(100 * kMiB)}) {
    const NodeMemory memory = share_node_memory(1024 * kMiB, {still, {}}, film(1));
    EXPECT_EQ(memory.frames, 1024 * kMiB);
    EXPECT_EQ(memory.still, 0u);
    EXPECT_EQ(memory.still_plan.lines, 1080u) << "CZB comes on top";
  }
}

TEST(NodeMemory, WithSeveralSamplesAQuarterIsForStillParts) {
  for (const std::uint32_t samples : {2u, 4u, 8u, 16u}) {
    const NodeMemory memory = share_node_memory(1024 * kMiB, {}, film(samples));
    EXPECT_EQ(memory.still, 256 * kMiB);
    EXPECT_EQ(memory.frames, 768 * kMiB);
    const wire::StillPlan plan = wire::plan_still_lines(1920, 1080, samples, 256 * kMiB);
    EXPECT_EQ(memory.still_plan.lines, plan.lines);
    EXPECT_EQ(memory.still_plan.line_bytes, plan.line_bytes);
  }
  EXPECT_EQ(share_node_memory(1024 * kMiB, {}, film(4)).still_plan.lines, 1080u);
  EXPECT_LT(share_node_memory(64 * kMiB, {}, film(16)).still_plan.lines, 1080u);
}

TEST(NodeMemory, AGivenPartIsTakenButNoMoreThanThereIs) {
  EXPECT_EQ(share_node_memory(1024 * kMiB, {0, {}}, film(4)).frames, 1024 * kMiB);
  EXPECT_EQ(share_node_memory(1024 * kMiB, {24 * kMiB, {}}, film(4)).frames, 1000 * kMiB);
  EXPECT_EQ(share_node_memory(1024 * kMiB, {2000 * kMiB, {}}, film(4)).frames, 0u);
}

// Within a quarter, as far as it is of use and suffices.
TEST(NodeMemory, ShadowsTakeAPart) {
  const shadow::ShadowNeeds needs{1920, 4, 2, 1000};
  const std::uint64_t least = shadow::least_shadow_bytes(needs), most = shadow::most_shadow_bytes(needs);
  for (const std::uint64_t bytes : {2 * least, 8 * least, 16 * least}) {
    const NodeMemory memory = share_node_memory(bytes, {}, film(4), needs);
    EXPECT_LE(memory.shadows, std::max(least, bytes / 4));
    EXPECT_GE(memory.shadows, least);
    EXPECT_EQ(memory.frames + memory.still + memory.shadows, bytes);
    EXPECT_GE(memory.frames, bytes / 4);
  }
  EXPECT_EQ(share_node_memory(4096 * kMiB, {}, film(4), needs).shadows, most);
  EXPECT_EQ(share_node_memory(4096 * kMiB, {{}, 0}, film(4), needs).shadows, least);
  EXPECT_EQ(share_node_memory(4096 * kMiB, {}, film(4)).shadows, 0u);
}

TEST(NodeMemory, FramesWithShadowsTakePassesRatherThanGigabytes) {
  const shadow::ShadowNeeds needs{1920, 4, 2, 1000};
  EXPECT_EQ(share_node_memory(4096 * kMiB, {}, film(4), needs, 1).frames, 1280 * kMiB);
  EXPECT_EQ(share_node_memory(4096 * kMiB, {}, film(4), needs, 3).frames, 1280 * kMiB / 3);
  EXPECT_EQ(share_node_memory(4096 * kMiB, {}, film(4), needs, 100).frames, 128 * kMiB);
  EXPECT_GT(share_node_memory(4096 * kMiB, {}, film(4), {}, 100).frames, 1024 * kMiB);
}

TEST(NodeMemory, ShadowsThatNeedMoreThanHalfAreRefused) {
  const shadow::ShadowNeeds needs{1920, 4, 2, 1000};
  const std::uint64_t least = shadow::least_shadow_bytes(needs);
  check_shadow_memory(2 * least, needs);
  check_shadow_memory(1, {1920, 4, 0, 1000});
  try {
    check_shadow_memory(2 * least - 2, needs);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_NE(failure.remedy.find("set MARS_MEMORY to " + std::to_string((2 * least >> 20) + 1)), std::string::npos)
        << failure.remedy;
  }
}

}  // namespace
}  // namespace mars::farm
