// Lines in pictures, pixel by pixel: the eye at the origin looks along -z, a picture of 100 x 100 pixels spans
// -w .. w at distance w.
#include "host/preview/drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "host/preview/film_drawing.h"

namespace mars::preview {
namespace {

constexpr Color kBlack{0, 0, 0}, kWhite{1, 1, 1}, kRed{1, 0, 0}, kGreen{0, 1, 0};
constexpr Placing kHere{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

wire::Camera eye() {
  wire::Camera camera{};
  for (std::size_t i = 0; i < 3; ++i) camera.world_to_eye.m[i][i] = 1;
  camera.focal = 1;
  camera.near = 0.5;
  camera.far = 1000;
  return camera;
}

Lines line(std::array<float, 3> from, std::array<float, 3> to) {
  return {{from[0], from[1], from[2], to[0], to[1], to[2]}, {0, 1}, 0};
}

using Pixels = std::set<std::pair<int, int>>;  // column, row

Pixels drawn(const Drawing& drawing, std::uint32_t background = 0) {
  Pixels pixels;
  const images::Image& image = drawing.image();
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x)
      if (image.pixels[std::size_t{y} * image.width + x] != background) pixels.insert({int(x), int(y)});
  return pixels;
}

Pixels drawn_alone(const Lines& lines, const Stroke& stroke = {}) {
  Drawing drawing(100, 100);
  drawing.begin(eye(), kBlack, 1, 1000);
  drawing.draw(lines, kHere, kWhite, stroke);
  return drawn(drawing);
}

Pixels row(int y, int first, int last) {
  Pixels pixels;
  for (int x = first; x <= last; ++x) pixels.insert({x, y});
  return pixels;
}

Pixels column(int x, int first, int last) {
  Pixels pixels;
  for (int y = first; y <= last; ++y) pixels.insert({x, y});
  return pixels;
}

TEST(Drawing, PlacesAreProjectedByHand) {
  // At distance 2 a length of 1 is 25 pixels; y is down.
  EXPECT_EQ(drawn_alone(line({-1, 0, -2}, {1, 0, -2})), row(50, 25, 75));
  EXPECT_EQ(drawn_alone(line({0.5f, 1, -2}, {0.5f, -1, -2})), column(62, 25, 75));
  // At distance 4 half as large.
  EXPECT_EQ(drawn_alone(line({-1, 0.4f, -4}, {1, 0.4f, -4})), row(45, 37, 62));
}

TEST(Drawing, DiagonalsHaveOnePixelAColumn) {
  Pixels diagonal;
  for (int i = 25; i <= 75; ++i) diagonal.insert({i, i});
  EXPECT_EQ(drawn_alone(line({-0.99f, 0.99f, -2}, {1.01f, -1.01f, -2})), diagonal);
}

TEST(Drawing, MatricesPlaceLines) {
  Drawing drawing(100, 100);
  drawing.begin(eye(), kBlack, 1, 1000);
  const Placing twice_and_back{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, -2};
  drawing.draw(line({-0.5f, 0, 0}, {0.5f, 0, 0}), twice_and_back, kWhite);
  EXPECT_EQ(drawn(drawing), row(50, 25, 75));
}

TEST(Drawing, LinesAreCutAtTheNearPlane) {
  // Straight up and behind the eye: it leaves the picture by its upper edge.
  EXPECT_EQ(drawn_alone(line({0, 0, -2}, {0, 2, 2})), column(50, 0, 50));
  EXPECT_EQ(drawn_alone(line({0, 2, 2}, {0, 0, -2})), column(50, 0, 50));
  EXPECT_EQ(drawn_alone(line({-1, 0, 3}, {1, 0, 2})), Pixels{});
  EXPECT_EQ(drawn_alone(line({-1, 0, -0.4f}, {1, 0, -0.4f})), Pixels{});  // nearer than near
}

TEST(Drawing, LinesAreCutAtThePicturesEdges) {
  EXPECT_EQ(drawn_alone(line({-1e6f, 0, -2}, {1e6f, 0, -2})), row(50, 0, 99));
  EXPECT_EQ(drawn_alone(line({-3, 2.5f, -2}, {3, 2.5f, -2})), Pixels{});
  EXPECT_EQ(drawn_alone(line({-1e30f, 1e30f, -2}, {1e30f, 1e30f, -2})), Pixels{});
}

// Against the line's equation in double precision.
TEST(Drawing, RandomLinesPassNextToTheirPixelsMiddles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-3, 3);  // a third of them leave the picture
  for (int i = 0; i < 2000; ++i) {
    const float x0 = coordinate(random), y0 = coordinate(random), x1 = coordinate(random), y1 = coordinate(random);
    const Pixels pixels = drawn_alone(line({x0, y0, -2}, {x1, y1, -2}));
    const double ax = 50 + 25.0 * x0, ay = 50 - 25.0 * y0, bx = 50 + 25.0 * x1, by = 50 - 25.0 * y1;
    const bool flat = std::abs(bx - ax) >= std::abs(by - ay);
    std::set<int> along;
    for (const auto& [x, y] : pixels) {
      const double at =
          flat ? ay + (x + 0.5 - ax) * (by - ay) / (bx - ax) : ax + (y + 0.5 - ay) * (bx - ax) / (by - ay);
      EXPECT_NEAR(at, (flat ? y : x) + 0.5,
                  0.51 + (flat ? std::abs((by - ay) / (bx - ax)) : std::abs((bx - ax) / (by - ay))) * 0.5);
      EXPECT_TRUE(along.insert(flat ? x : y).second) << "two pixels in one column";
    }
    if (!along.empty()) {
      EXPECT_EQ(*along.rbegin() - *along.begin() + 1, int(along.size())) << "a gap";
    }
  }
}

TEST(Drawing, NearerLinesHideFartherOnes) {
  for (const bool near_first : {true, false}) {
    Drawing drawing(100, 100);
    drawing.begin(eye(), kBlack, 1, 1e9);
    const auto near = [&] { drawing.draw(line({-1, 0, -2}, {1, 0, -2}), kHere, kRed); };
    const auto far = [&] { drawing.draw(line({0, -2, -4}, {0, 2, -4}), kHere, kGreen); };
    near_first ? (near(), far()) : (far(), near());
    EXPECT_GT(drawing.image().pixels[50 * 100 + 50] & 0xff, 200u);
    EXPECT_EQ(drawing.image().pixels[50 * 100 + 50] & 0xff00, 0u);
  }
}

TEST(Drawing, FartherLinesAreDimmer) {
  Drawing drawing(100, 100);
  drawing.begin(eye(), kBlack, 1, 9);
  drawing.draw(line({-0.1f, 0, -1}, {0.1f, 0, -1}), kHere, kWhite);
  drawing.draw(line({-1, 3, -5}, {1, 3, -5}), kHere, kWhite);
  EXPECT_EQ(drawing.image().pixels[50 * 100 + 50], 0xffffffu);
  EXPECT_NEAR(double(drawing.image().pixels[20 * 100 + 50] & 0xff), 255 * (1 + 0.28) / 2, 2);
}

TEST(Drawing, PensAreSoWide) {
  Pixels two = row(50, 25, 75);
  two.merge(row(51, 25, 75));
  EXPECT_EQ(drawn_alone(line({-1, 0, -2}, {1, 0, -2}), {2, 1}), two);
}

TEST(Drawing, DotsMarkTheFirstPoints) {
  Lines points{{0, 0, -2, 1, 0, -2}, {}, 1};
  EXPECT_EQ(drawn_alone(points, {1, 1}), (Pixels{{50, 50}}));
  EXPECT_EQ(drawn_alone(points, {1, 3}).size(), 9u);
  points = {{-2, 2, -2, 5, 5, -2, 0, 0, 2}, {}, 3};  // in the corner; outside; behind
  EXPECT_EQ(drawn_alone(points, {1, 3}),
            (Pixels{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}}));
}

TEST(FilmDrawing, DarkMaterialsAreLiftedAboveThePaper) {
  for (const Color color : {Color{0, 0, 0}, Color{0.1f, 0, 0}, Color{0.2f, 0.2f, 0.3f}}) {
    const Color lifted = line_color(color);
    EXPECT_GT(std::max({lifted[0], lifted[1], lifted[2]}), 0.6f);
  }
  EXPECT_EQ(line_color({0.9f, 0.1f, 0}), (Color{0.9f, 0.1f, 0}));
}

TEST(FilmDrawing, HalvingTakesTheMean) {
  const images::Image half = halved({2, 2, {0x000000, 0x0000ff, 0x00ff00, 0x00ffff}});
  EXPECT_EQ(half.width, 1u);
  EXPECT_EQ(half.pixels, (std::vector<std::uint32_t>{0x008080}));
}

}  // namespace
}  // namespace mars::preview
