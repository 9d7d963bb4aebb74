#include "host/render/farm/host_memory.h"

#include <gtest/gtest.h>

#include "node/wire/protocol.h"

namespace mars::farm {
namespace {

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;

wire::FilmSettings picture(std::uint32_t width, std::uint32_t height) {
  wire::FilmSettings settings{};
  settings.width = width;
  settings.height = height;
  return settings;
}

TEST(SharedHostMemory, OrdinaryFilmsHaveAllTheyCanUse) {
  const HostMemory memory = share_host_memory(4 * kGiB, picture(1920, 1080), wire::PixelFormat::rgb8, 64, 8, 16);
  EXPECT_EQ(memory.frames, 18u) << "two more than threads";
  EXPECT_EQ(memory.credits, wire::kMaxCredits);
  EXPECT_EQ(memory.backgrounds, 8u + 18u);
  EXPECT_EQ(memory.strip_bytes(), 64u * 4 * wire::kMaxStripBytes);
  EXPECT_LT(memory.most_bytes(), memory.budget);
}

TEST(SharedHostMemory, BuffersTakeAGiBOrAnEighthAtMost) {
  EXPECT_EQ(share_host_memory(8 * kGiB, picture(16384, 8192), wire::PixelFormat::rgb8, 1, 1, 16).frames, 2u);
  EXPECT_EQ(share_host_memory(8 * kGiB, picture(8192, 8192), wire::PixelFormat::rgb8, 1, 1, 16).frames, 4u);
  EXPECT_EQ(share_host_memory(16 * kGiB, picture(8192, 8192), wire::PixelFormat::rgb8, 1, 1, 16).frames, 8u);
}

TEST(SharedHostMemory, PixelsOfEightBytesTakeTwice) {
  const HostMemory narrow = share_host_memory(8 * kGiB, picture(8192, 8192), wire::PixelFormat::rgb8, 1, 1, 16);
  const HostMemory wide = share_host_memory(8 * kGiB, picture(8192, 8192), wire::PixelFormat::half, 1, 1, 16);
  EXPECT_EQ(wide.frame_bytes, 2 * narrow.frame_bytes);
  EXPECT_EQ(wide.frames, narrow.frames / 2);
  EXPECT_EQ(wide.strip_bytes(), narrow.strip_bytes());
}

TEST(SharedHostMemory, ManyNodesHaveFewerCredits) {
  std::int32_t before = wire::kMaxCredits;
  for (const std::uint32_t nodes : {256u, 1024u, 2048u, 4096u}) {
    const HostMemory memory = share_host_memory(4 * kGiB, picture(1920, 1080), wire::PixelFormat::rgb8, nodes, 1, 16);
    EXPECT_LE(memory.credits, before);
    EXPECT_GE(memory.credits, 1);
    EXPECT_LE(memory.most_bytes(), memory.budget);
    before = memory.credits;
  }
  EXPECT_LT(before, wire::kMaxCredits);
}

TEST(SharedHostMemory, WhereNodesWriteThereIsOnePicture) {
  const HostMemory shared = share_host_memory(4 * kGiB, picture(1920, 1080), wire::PixelFormat::rgb8, 4096, 8, 16);
  const HostMemory used = where_nodes_write(shared);
  EXPECT_EQ(used.most_bytes(), used.frame_bytes);
  EXPECT_EQ(used.credits, shared.credits) << "slots are the nodes'";
}

TEST(SharedHostMemory, HoweverSmallTheBudgetWorkGoesOn) {
  const HostMemory memory = share_host_memory(0, picture(1920, 1080), wire::PixelFormat::rgb8, 8, 2, 16);
  EXPECT_EQ(memory.frames, 2u);
  EXPECT_EQ(memory.credits, 1);
  EXPECT_GT(memory.most_bytes(), memory.budget);
}

}  // namespace
}  // namespace mars::farm
