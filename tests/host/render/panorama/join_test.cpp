// Joining faces: against a plain twin in double precision, and against functions of the direction painted on the faces.
#include "host/render/panorama/join.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "host/content/film/panorama.h"
#include "host/images/half_light.h"

namespace mars::panorama {
namespace {

using Vector = std::array<double, 3>;
using Paint = std::function<Vector(const Vector& direction)>;

double dot(const std::array<int, 3>& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector unit(const Vector& v) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

// Of a point of the picture, in pixels from its left and upper edge.
Vector direction_at(double x, double y, double width) {
  const double longitude = (x / width - 0.5) * 2 * std::numbers::pi,
               latitude = (0.5 - 2 * y / width) * std::numbers::pi;
  return {std::sin(longitude) * std::cos(latitude), std::sin(latitude), std::cos(longitude) * std::cos(latitude)};
}

color::Encoding encoding_of(wire::PixelFormat format) {
  return color::encoding_of(wire::FilmSettings{}, wire::Camera{}, format);
}

// Pictures of light as nodes would draw it.
std::vector<images::Image> painted(std::uint32_t width, const Paint& paint) {
  const std::uint32_t side = film::face_side(width), pixels = film::face_pixels(width);
  std::vector<images::Image> pictures;
  for (const film::FaceAxes& axes : film::kFaceAxes) {
    images::Image& picture = pictures.emplace_back(images::Image{side, side, {}});
    for (std::uint32_t row = 0; row < side; ++row) {
      for (std::uint32_t column = 0; column < side; ++column) {
        const double right = (2 * column + 1.0 - side) / pixels, up = (side - 1.0 - 2 * row) / pixels;
        Vector direction;
        for (std::size_t i = 0; i < 3; ++i) direction[i] = axes.ahead[i] + right * axes.right[i] + up * axes.up[i];
        const Vector color = paint(unit(direction));
        const float light[] = {float(color[0]), float(color[1]), float(color[2])};
        const std::uint64_t pixel = color::pixel_of(encoding_of(wire::PixelFormat::half), light);
        picture.pixels.push_back(static_cast<std::uint32_t>(pixel));
        picture.pixels.push_back(static_cast<std::uint32_t>(pixel >> 32));
      }
    }
  }
  return pictures;
}

std::vector<Face> faces_of(const std::vector<images::Image>& pictures) { return {pictures.begin(), pictures.end()}; }

double light_in(const images::Image& picture, std::size_t column, std::size_t row, std::size_t channel) {
  const std::size_t pixel = row * picture.width + column;
  const std::uint32_t word = picture.pixels[2 * pixel + channel / 2];
  return static_cast<double>(images::light_of_half(channel % 2 == 0 ? word & 0xffff : word >> 16));
}

// The face before which the direction goes farthest ahead.
Vector looked_up(const std::vector<images::Image>& pictures, const Vector& direction, double pixels) {
  const auto axes = std::ranges::max_element(film::kFaceAxes, {},
                                             [&](const film::FaceAxes& each) { return dot(each.ahead, direction); });
  const images::Image& picture = pictures[static_cast<std::size_t>(axes - film::kFaceAxes.begin())];
  const double ahead = dot(axes->ahead, direction), middle = (picture.width - 1) / 2.0;
  const double column = middle + pixels / 2 * dot(axes->right, direction) / ahead;
  const double row = middle - pixels / 2 * dot(axes->up, direction) / ahead;
  const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
  Vector light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = std::lerp(
        std::lerp(light_in(picture, x, y, c), light_in(picture, x + 1, y, c), column - static_cast<double>(x)),
        std::lerp(light_in(picture, x, y + 1, c), light_in(picture, x + 1, y + 1, c), column - static_cast<double>(x)),
        row - static_cast<double>(y));
  return light;
}

TEST(Panorama, IsWhatAPlainTwinJoins) {
  for (const std::uint32_t width : {2u, 10u, 64u}) {
    std::mt19937 random(width);
    const auto pictures = painted(width, [&](const Vector&) -> Vector {
      const auto number = [&] { return static_cast<double>(random() % 1024) / 512; };
      return {number(), number(), number()};
    });
    const std::vector<Face> faces = faces_of(pictures);
    const Joiner joiner(width);
    for (std::uint32_t y = 0; y < joiner.height(); ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        Vector sum{};
        for (const double down : {1 / 6.0, 3 / 6.0, 5 / 6.0}) {
          for (const double across : {1 / 6.0, 3 / 6.0, 5 / 6.0}) {
            const Vector light =
                looked_up(pictures, direction_at(x + across, y + down, width), film::face_pixels(width));
            for (std::size_t c = 0; c < 3; ++c) sum[c] += light[c] / 9;
          }
        }
        const Light joined = joiner.light_at(faces, x, y);
        for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(joined[c], sum[c], 2e-4) << width << ": " << x << ", " << y;
      }
    }
  }
}

// At seams and poles, too: the error is that of half floats, and of a mean in place of the middle.
TEST(Panorama, ShowsSmoothLightAsItIs) {
  const Paint paint = [](const Vector& d) -> Vector {
    return {0.5 + 0.4 * d[0], 0.5 + 0.3 * d[1] - 0.2 * d[2], 0.6 + 0.3 * d[0] * d[1] + 0.2 * d[2] * d[2]};
  };
  constexpr std::uint32_t kWidth = 512;
  const std::vector<Face> faces = faces_of(painted(kWidth, paint));
  const Joiner joiner(kWidth);
  double worst = 0;
  for (std::uint32_t y = 0; y < joiner.height(); ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const Light joined = joiner.light_at(faces, x, y);
      const Vector wanted = paint(direction_at(x + 0.5, y + 0.5, kWidth));
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(double(joined[c]) - wanted[c]));
    }
  }
  EXPECT_LT(worst, 3e-4);
}

TEST(Panorama, DirectionsAreExactToFloats) {
  constexpr std::uint32_t kColumns = 600;
  const DirectionGrid grid(kColumns);
  for (std::uint32_t row = 0; row < kColumns / 2; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const Direction direction = grid.at(column, row);
      const Vector wanted = direction_at(column + 0.5, row + 0.5, kColumns);
      for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(direction[i], wanted[i], 1.5e-7) << column << ", " << row;
    }
  }
}

// Interpolation never reads beside a face, whose middle has at least the panorama's pixels for an angle.
TEST(Panorama, FacesAreLargeEnough) {
  for (const std::uint32_t width : {2u, 4u, 100u, 1024u, 16384u}) {
    EXPECT_GE(film::face_pixels(width), width / std::numbers::pi);
    EXPECT_LE(film::face_pixels(width), width / std::numbers::pi + 2);
  }
  const auto pixels = static_cast<float>(film::face_pixels(16384)),
             last = static_cast<float>(film::face_side(16384) - 1);
  for (const float x : {-1.0f, -0.3f, 1.0f}) {
    for (const float y : {-1.0f, 0.7f, 1.0f}) {
      for (const Direction& direction :
           {Direction{x, y, 1}, {x, y, -1}, {1, x, y}, {-1, x, y}, {x, 1, y}, {x, -1, y}}) {
        const FacePlace place = place_of(direction, pixels);
        for (const float at : {place.column, place.row}) {
          EXPECT_GE(at, 0.0f);
          EXPECT_LT(at, last);
        }
      }
    }
  }
}

TEST(Panorama, AlphaIsStraightInLevelsAndPremultipliedInLight) {
  const Light half_red{0.4f, 0, 0, 0.5f};
  EXPECT_EQ(pixel_of(encoding_of(wire::PixelFormat::rgba8), half_red), 0x800000ccu);
  EXPECT_EQ(pixel_of(encoding_of(wire::PixelFormat::rgba16), half_red), 0x800000000000ccccull);
  EXPECT_EQ(pixel_of(encoding_of(wire::PixelFormat::half_alpha), half_red), 0x3800000000003666ull);
  EXPECT_EQ(pixel_of(encoding_of(wire::PixelFormat::rgba8), Light{}), 0u);
  EXPECT_EQ(pixel_of(encoding_of(wire::PixelFormat::rgb8), half_red), 0x66u);
}

}  // namespace
}  // namespace mars::panorama
