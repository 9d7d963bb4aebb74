// Marked tiles against a plain table of pixels.
#include "node/raster/still_marks.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/node/shape/patches.h"

namespace mars::raster {
namespace {

constexpr std::uint32_t kMarkedHeight = 21;

std::vector<bool> marked_columns(const StillMarks& marks, std::uint32_t line, std::uint32_t width) {
  std::vector<bool> columns(width);
  std::uint32_t done = 0;
  visit_columns(marks.on(line), width, [&](std::uint32_t first, std::uint32_t last) {
    EXPECT_LT(first, last);
    EXPECT_TRUE(done == 0 || done < first) << "neighbours are visited together";
    done = last;
    for (std::uint32_t x = first; x < last; ++x) columns.at(x) = true;
  });
  return columns;
}

TEST(StillMarks, AreTheTilesOfThePixelsMarked) {
  shape::Random random(3);
  for (const std::uint32_t width : {1u, 8u, 9u, 100u, 511u, 512u, 513u, 1030u}) {
    StillMarks marks(width, kMarkedHeight);
    std::vector<std::vector<bool>> plain(kMarkedHeight, std::vector<bool>(width));
    const auto number = [&](std::uint32_t below) { return static_cast<std::uint32_t>(random.real(0, below)); };
    for (int k = 0; k < 5; ++k) {
      const std::uint32_t top = number(kMarkedHeight), left = number(width);
      const geometry::LineRange lines{top, std::min(kMarkedHeight, top + number(9))};
      const geometry::ColumnRange columns{left, std::min(width, left + number(70))};
      marks.mark(lines, columns);
      for (std::uint32_t y = lines.first; y < lines.last; ++y)
        for (std::uint32_t x = columns.first; x < columns.last; ++x)
          for (std::uint32_t v = y / 8 * 8; v < std::min(kMarkedHeight, y / 8 * 8 + 8); ++v)
            for (std::uint32_t u = x / 8 * 8; u < std::min(width, x / 8 * 8 + 8); ++u) plain[v][u] = true;
    }
    for (std::uint32_t y = 0; y < kMarkedHeight; ++y) {
      ASSERT_EQ(marked_columns(marks, y, width), plain[y]) << width << " columns, line " << y;
      std::uint32_t count = 0;
      for (std::uint32_t x = 0; x < width; ++x) {
        ASSERT_EQ(has_column(marks.on(y), x), plain[y][x]);
        count += plain[y][x] ? 1 : 0;
      }
      EXPECT_EQ(count_columns(marks.on(y), width), count);
      EXPECT_EQ(any(marks.on(y)), count > 0);
    }
  }
}

TEST(StillMarks, OtherColumnsAreTheRest) {
  shape::Random random(5);
  for (const std::uint32_t width : {7u, 64u, 515u}) {
    StillMarks marks(width, 8);
    for (std::uint32_t tile = 0; tile < wire::still_tiles(width); ++tile)
      if (random.real(0, 1) < 0.4) marks.mark_tile(tile);
    std::vector<bool> columns = marked_columns(marks, 0, width);
    visit_other_columns(marks.on(0), width, [&](std::uint32_t first, std::uint32_t last) {
      EXPECT_LT(first, last);
      for (std::uint32_t x = first; x < last; ++x) {
        EXPECT_FALSE(columns.at(x));
        columns[x] = true;
      }
    });
    EXPECT_EQ(columns, std::vector<bool>(width, true));
  }
}

TEST(StillMarks, AllAndNone) {
  StillMarks marks(517, kMarkedHeight);
  EXPECT_FALSE(any(marks.on(0)));
  marks.mark_all();
  for (std::uint32_t y = 0; y < kMarkedHeight; ++y) EXPECT_EQ(count_columns(marks.on(y), 517), 517u);
  marks.clear();
  marks.mark_tile(wire::still_tiles(517) + 1);
  EXPECT_EQ(count_columns(marks.on(7), 517), 0u);
  EXPECT_TRUE(has_column(marks.on(8), 15));
  EXPECT_EQ(count_columns(marks.on(8), 517), 8u);
}

}  // namespace
}  // namespace mars::raster
