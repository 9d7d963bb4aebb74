#include "host/window/screen/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mars::window {
namespace {

using compositor::Rect;
using Pixels = std::vector<std::uint32_t>;

constexpr std::uint32_t kYellow = 0x0000d7ff;

// A picture of pixels 1, 2, 3 ... in a window whose first content was taken.
Canvas canvas_of(images::PictureSize picture, images::PictureSize window, Zoom zoom = Zoom::fit) {
  Canvas canvas;
  canvas.begin(picture);
  canvas.resize(window);
  canvas.zoom(zoom);
  Pixels pixels(std::size_t{picture.width} * picture.height);
  for (std::uint32_t i = 0; i < pixels.size(); ++i) pixels[i] = i + 1;
  const Rect whole{0, 0, static_cast<std::uint16_t>(picture.width), static_cast<std::uint16_t>(picture.height)};
  canvas.paste(std::span(&whole, 1), pixels);
  canvas.take_changed();
  return canvas;
}

void paste(Canvas& canvas, const Rect& rect, std::uint32_t pixel) {
  canvas.paste(std::span(&rect, 1), Pixels(std::size_t{rect.width} * rect.height, pixel));
}

TEST(Canvas, EnlargesByWholeFactorsInTheMiddle) {
  EXPECT_EQ(canvas_of({2, 1}, {5, 4}).pixels(), (Pixels{0, 0, 0, 0, 0, 1, 1, 2, 2, 0, 1, 1, 2, 2, 0, 0, 0, 0, 0, 0}));
}

TEST(Canvas, ReducesToMeans) {
  EXPECT_EQ(canvas_of({4, 2}, {2, 9}).pixels()[4 * 2], 4u) << "of 1, 2, 5 and 6, rounded";
  EXPECT_EQ(canvas_of({4, 2}, {2, 9}).pixels()[4 * 2 + 1], 6u) << "of 3, 4, 7 and 8, rounded";
}

TEST(Canvas, MayHaveNoColumns) {
  EXPECT_TRUE(canvas_of({4, 2}, {0, 3}).pixels().empty());
  EXPECT_TRUE(canvas_of({4, 2}, {3, 0}).pixels().empty());
}

TEST(Canvas, ShowsPixelsOneToOneWhereAPersonMovesThem) {
  Canvas canvas = canvas_of({6, 1}, {2, 1}, Zoom::one_to_one);
  EXPECT_EQ(canvas.pixels(), (Pixels{3, 4}));
  canvas.move({1, 0});
  canvas.take_changed();
  EXPECT_EQ(canvas.pixels(), (Pixels{2, 3}));
  canvas.move({100, 0});
  canvas.move({-1, 0});
  canvas.take_changed();
  EXPECT_EQ(canvas.pixels(), (Pixels{2, 3})) << "it was moved no farther than it reaches";
}

TEST(Canvas, OnlyWhatCameHasChanged) {
  Canvas canvas = canvas_of({4, 4}, {8, 8});
  EXPECT_TRUE(canvas.take_changed().empty());
  paste(canvas, {1, 2, 2, 1}, 99);
  EXPECT_EQ(canvas.take_changed(), (std::vector<Area>{{2, 4, 4, 2}}));
  EXPECT_EQ(canvas.pixels()[4 * 8 + 2], 99u);
  EXPECT_TRUE(canvas.take_changed().empty());
}

// Whatever the sizes: areas drawn one by one make the same window as all at once.
TEST(Canvas, PartsMakeTheWhole) {
  for (const images::PictureSize window : {images::PictureSize{7, 5}, {16, 16}, {40, 30}, {13, 90}})
    for (const Zoom zoom : {Zoom::fit, Zoom::one_to_one}) {
      Canvas parts = canvas_of({16, 16}, window, zoom), whole = canvas_of({16, 16}, window, zoom);
      for (std::uint16_t i = 0; i < 12; ++i) {
        const Rect rect{i, static_cast<std::uint16_t>((7 * i) % 13), 3, 2};
        paste(parts, rect, 1000u * i);
        parts.take_changed();
        paste(whole, rect, 1000u * i);
      }
      whole.resize(window);
      whole.take_changed();
      EXPECT_EQ(parts.pixels(), whole.pixels()) << window.width << " x " << window.height;
    }
}

TEST(Canvas, OutlinesWhatCameUntilMoreComes) {
  Canvas canvas = canvas_of({8, 8}, {8, 8});
  const Pixels before = canvas.pixels();
  const auto yellow = [&] { return std::ranges::count(canvas.pixels(), kYellow); };
  canvas.outline(true);
  paste(canvas, {1, 1, 3, 3}, 7);
  canvas.take_changed();
  EXPECT_EQ(yellow(), 8);
  EXPECT_EQ(canvas.pixels()[2 * 8 + 2], 7u);
  paste(canvas, {5, 5, 2, 2}, 8);
  EXPECT_EQ(canvas.take_changed(), (std::vector<Area>{{5, 5, 2, 2}, {1, 1, 3, 3}}));
  EXPECT_EQ(yellow(), 4);
  EXPECT_EQ(canvas.pixels()[1 * 8 + 1], 7u) << "the earlier outline is gone";
  canvas.outline(false);
  canvas.take_changed();
  EXPECT_EQ(yellow(), 0);
}

}  // namespace
}  // namespace mars::window
