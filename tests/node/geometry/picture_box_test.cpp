// Boxes on the picture against points of the hull and against what dicing makes of patches, also near the near plane.
#include "node/geometry/picture_box.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/node/shape/patches.h"

namespace mars::geometry {
namespace {

constexpr PictureSize kPicture{200, 150};
const shape::Projection kProjection = shape::projection(200, 150, 2, 0.1, 1000);

std::array<double, 2> place_of(const std::array<double, 3>& point) {
  const double w = -point[2];
  return {kProjection.center[0] + kProjection.scale * point[0] / w,
          kProjection.center[1] - kProjection.scale * point[1] / w};
}

bool has(const PictureBounds& bounds, const std::array<double, 2>& place) {
  const bool is_shown = place[0] >= 0 && place[0] < kPicture.width && place[1] >= 0 && place[1] < kPicture.height;
  const auto column = static_cast<std::uint32_t>(is_shown ? place[0] : 0),
             line = static_cast<std::uint32_t>(is_shown ? place[1] : 0);
  return !is_shown || (bounds.lines.has(line) && bounds.columns.first <= column && column < bounds.columns.last);
}

TEST(PictureBox, HasAllThatLiesBetweenItsPoints) {
  shape::Random random(4);
  int small = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    float points[5][3];
    const double away = random.real(0.05, 20), size = random.real(0.01, 3);
    for (auto& point : points) {
      for (int a = 0; a < 2; ++a)
        point[a] = static_cast<float>(random.real(-away, away) / 4 + random.real(-size, size));
      point[2] = static_cast<float>(-away - random.real(-size, size));
    }
    const PictureBounds bounds = picture_box(points, 5, kProjection, kPicture);
    small += bounds.lines.count() < kPicture.height / 2 ? 1 : 0;
    for (int k = 0; k < 50; ++k) {
      std::array<double, 5> parts{};
      double all = 0;
      for (double& part : parts) all += part = random.real(0, 1) * random.real(0, 1);
      std::array<double, 3> inside{};
      for (int i = 0; i < 5; ++i)
        for (std::size_t a = 0; a < 3; ++a)
          inside[a] += parts[static_cast<std::size_t>(i)] / all * double{points[i][a]};
      if (-inside[2] < double{kProjection.near}) continue;
      EXPECT_TRUE(has(bounds, place_of(inside))) << trial;
    }
  }
  EXPECT_GT(small, 500);
}

TEST(PictureBox, OfWhatIsBehindTheEyeIsAllOfThePicture) {
  const float points[2][3] = {{0, 0, -1}, {0, 0, 1}};
  const PictureBounds bounds = picture_box(points, 2, kProjection, kPicture);
  EXPECT_EQ(bounds.lines, (LineRange{0, kPicture.height}));
}

TEST(PictureBox, OfWhatIsBesideThePictureIsEmpty) {
  const float above[1][3] = {{0, 50, -10}}, beside[1][3] = {{50, 0, -10}};
  EXPECT_EQ(picture_box(above, 1, kProjection, kPicture).lines.count(), 0u);
  EXPECT_EQ(picture_box(beside, 1, kProjection, kPicture).lines.count(), 0u);
}

}  // namespace
}  // namespace mars::geometry
