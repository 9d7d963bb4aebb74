#include "host/render/compositor/rectangles.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace {

using mars::compositor::BlockFlags;
using mars::compositor::Rect;

// How often each pixel is in a rectangle.
std::vector<int> coverage(const std::vector<Rect>& rects, std::uint32_t width, std::uint32_t height) {
  std::vector<int> times(std::size_t{width} * height);
  for (const Rect& rect : rects)
    for (std::uint32_t y = rect.y; y < std::uint32_t{rect.y} + rect.height; ++y)
      for (std::uint32_t x = rect.x; x < std::uint32_t{rect.x} + rect.width; ++x) ++times.at(y * width + x);
  return times;
}

TEST(Rectangles, AllBlocksAreOnePicture) {
  BlockFlags flags(100, 50, 16);
  flags.set_all();
  const std::vector<Rect> rects = mars::compositor::rectangles_of(flags, 100, 50);
  ASSERT_EQ(rects.size(), 1u);
  EXPECT_EQ(rects[0].width, 100);
  EXPECT_EQ(rects[0].height, 50);
}

TEST(Rectangles, CoverFlaggedBlocksOnce) {
  constexpr std::uint32_t kWidth = 70, kHeight = 45, kBlock = 8;
  BlockFlags flags(kWidth, kHeight, kBlock);
  for (const auto& [line, first, count] : {std::array{0u, 0u, 20u},
                                           {8u, 0u, 20u},
                                           {16u, 8u, 1u},
                                           {17u, 40u, 30u},
                                           {24u, 8u, 1u},
                                           {25u, 30u, 40u},
                                           {44u, 69u, 1u}})
    flags.set_pixels(line, first, count);
  const std::vector<Rect> rects = mars::compositor::rectangles_of(flags, kWidth, kHeight);
  const std::vector<int> times = coverage(rects, kWidth, kHeight);
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      ASSERT_EQ(times[y * kWidth + x], flags.at(x / kBlock, y / kBlock) ? 1 : 0) << x << ", " << y;
  EXPECT_EQ(rects.size(), 5u);
}

TEST(Rectangles, NothingFlaggedIsNone) {
  EXPECT_TRUE(mars::compositor::rectangles_of(BlockFlags(64, 64, 16), 64, 64).empty());
}

}  // namespace
