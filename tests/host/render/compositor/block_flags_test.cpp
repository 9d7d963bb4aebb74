#include "host/render/compositor/block_flags.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>
#include <vector>

namespace mars::compositor {
namespace {

using Blocks = std::set<std::pair<std::uint32_t, std::uint32_t>>;  // row, column

Blocks blocks_of(const BlockFlags& flags) {
  Blocks blocks;
  for (std::uint32_t row = 0; row < flags.rows(); ++row)
    for (std::uint32_t column = 0; column < flags.columns(); ++column)
      if (flags.at(column, row)) blocks.insert({row, column});
  return blocks;
}

Blocks stretches_of(const BlockFlags& flags) {
  Blocks blocks;
  for (std::uint32_t row = 0; row < flags.rows(); ++row) {
    std::uint32_t end = 0;
    flags.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
      EXPECT_LT(first, last);
      EXPECT_LE(last, flags.columns());
      EXPECT_TRUE(first == 0 || first > end) << "stretches are unbroken";
      for (std::uint32_t column = first; column < last; ++column) blocks.insert({row, column});
      end = last;
    });
  }
  return blocks;
}

TEST(BlockFlags, CountBlocksThatArePartlyInThePicture) {
  const BlockFlags flags(33, 17, 16);
  EXPECT_EQ(flags.columns(), 3u);
  EXPECT_EQ(flags.rows(), 2u);
}

TEST(BlockFlags, PixelsFlagTheBlocksUnderThem) {
  std::mt19937 random(1);
  for (const std::uint32_t block : {1u, 2u, 3u, 7u, 16u, 64u, 1000u}) {
    for (const std::uint32_t width : {1u, 63u, 64u, 65u, 129u, 1000u}) {
      BlockFlags flags(width, 9, block);
      Blocks plain;
      for (int run = 0; run < 12; ++run) {
        const std::uint32_t line = random() % 9;
        const std::uint32_t first = random() % width;
        const std::uint32_t count = 1 + random() % (width - first);
        flags.set_pixels(line, first, count);
        for (std::uint32_t x = first; x < first + count; ++x) plain.insert({line / block, x / block});
      }
      EXPECT_EQ(blocks_of(flags), plain) << width << " pixels, blocks of " << block;
      EXPECT_EQ(stretches_of(flags), plain);
      EXPECT_EQ(flags.count(), plain.size());
    }
  }
}

TEST(BlockFlags, AllAndNone) {
  for (const std::uint32_t width : {1u, 64u, 65u, 128u, 200u}) {
    BlockFlags flags(width, 3, 1);
    flags.set_all();
    EXPECT_EQ(flags.count(), std::uint64_t{3} * width);
    EXPECT_EQ(stretches_of(flags).size(), std::size_t{3} * width);
    flags.clear();
    EXPECT_EQ(flags.count(), 0u);
    EXPECT_TRUE(stretches_of(flags).empty());
  }
}

TEST(BlockFlags, Join) {
  BlockFlags a(100, 100, 8);
  BlockFlags b(100, 100, 8);
  a.set_pixels(0, 0, 1);
  b.set_pixels(99, 99, 1);
  a |= b;
  EXPECT_EQ(blocks_of(a), (Blocks{{0, 0}, {12, 12}}));
  EXPECT_THROW(a |= BlockFlags(100, 100, 4), std::logic_error);
}

}  // namespace
}  // namespace mars::compositor
