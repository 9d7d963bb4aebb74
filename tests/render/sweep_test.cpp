// What moving parts and their shadows may change of the picture, against every point of theirs at every frame.
#include "node/geometry/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"

namespace mars::test {
namespace {

using Place = std::array<double, 3>;

constexpr std::uint32_t kSweepWidth = 200, kSweepHeight = 150;
constexpr double kFloor = 20;  // side of the floor, whose upper side is at z = 0

// Balls that rise and fall while they circle above a floor.
wire::FilmData circling(std::uint32_t balls, std::uint32_t frames, const wire::Light& light) {
  FilmMaker maker(kSweepWidth, kSweepHeight, frames);
  const std::uint32_t box = maker.add_shape(modeler::make_box()), ball = maker.add_shape(modeler::make_sphere());
  const std::uint32_t clay = maker.add_material(kClay);
  maker.add_segment(box, clay, {placed({-kFloor / 2, -kFloor / 2, -kFloor}, kFloor)});
  for (std::uint32_t b = 0; b < balls; ++b) {
    std::vector<wire::Matrix> motion;
    for (std::uint32_t f = 0; f < frames; ++f) {
      const double turn = 0.9 * f / frames + 0.001 * b;
      motion.push_back(placed({2 * std::cos(turn), 2 * std::sin(turn) - 1, 1.5 + std::sin(5 * turn)}, 0.5, f));
    }
    maker.add_segment(ball, clay, motion);
  }
  maker.add_light(light);
  maker.set_cameras({looking({0, -9, 5}, {0, 0, 0}, 60)});
  return maker.make();
}

wire::Light casting_light(wire::LightKind kind, const std::array<float, 3>& vector) {
  wire::Light light{kind, vector, {1, 1, 1}};
  light.casts = 1;
  return light;
}

Place moved(const wire::Matrix& m, const Place& p) {
  Place out;
  for (std::size_t r = 0; r < 3; ++r) out[r] = m.m[r][0] * p[0] + m.m[r][1] * p[1] + m.m[r][2] * p[2] + m.m[r][3];
  return out;
}

struct Swept {
  geometry::Sweep sweep;
  std::vector<std::uint8_t> covered = std::vector<std::uint8_t>(std::size_t{kSweepWidth} * kSweepHeight);  // by pixel

  Swept(const geometry::Scene& scene, std::uint32_t frames) {
    std::vector<std::uint32_t> all(frames);
    std::iota(all.begin(), all.end(), 0u);
    sweep.begin(scene, all, geometry::ShapeBoxes(scene.film()), [this](const geometry::PictureBounds& bounds) {
      for (std::uint32_t y = bounds.lines.first; y < bounds.lines.last; ++y)
        std::fill(covered.begin() + y * kSweepWidth + bounds.columns.first,
                  covered.begin() + y * kSweepWidth + bounds.columns.last, std::uint8_t{1});
    });
  }
  bool has_caster_round(const Place& eye) const {
    return std::ranges::any_of(sweep.casters(), [&](const geometry::SweptHull& hull) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax_element(hull.along[axis], hull.along[axis] + hull.count);
        if (eye[axis] < *low - 1e-4 || eye[axis] > *high + 1e-4) return false;
      }
      return true;
    });
  }
};

// On the floor; nowhere where `to_light` is not above it.
std::optional<Place> shadow_of(const Place& from, const Place& to_light) {
  if (to_light[2] <= 0) return std::nullopt;
  const double t = from[2] / to_light[2];
  const Place shadow{from[0] - t * to_light[0], from[1] - t * to_light[1], 0};
  if (std::abs(shadow[0]) > kFloor / 2 || std::abs(shadow[1]) > kFloor / 2) return std::nullopt;
  return shadow;
}

void expect_bounds(const wire::FilmData& data, std::size_t few, std::size_t most) {
  const FilmBlock block(data);
  geometry::Scene scene(block.view());
  scene.set_interval(0);
  scene.set_frame(0);
  const Swept swept(scene, data.settings.frames);
  EXPECT_GE(swept.sweep.casters().size(), few);
  EXPECT_LE(swept.sweep.casters().size(), most);
  const wire::Light& light = data.lights.front();
  const wire::Matrix& to_eye = data.cameras.front().world_to_eye;
  const shape::Projection& p = scene.projection();
  const auto pixel = [&](const Place& eye) {
    return std::array{p.center[0] - p.scale * eye[0] / eye[2], p.center[1] + p.scale * eye[1] / eye[2]};
  };
  const auto is_in_picture = [](const auto& at) {
    return 0 <= at[0] && at[0] < kSweepWidth && 0 <= at[1] && at[1] < kSweepHeight;
  };
  std::size_t shadows = 0;
  for (std::uint32_t frame = 0; frame < data.settings.frames; frame += 1 + data.settings.frames / 11)
    for (std::size_t s = 1; s < data.segments.size(); s += 1 + data.segments.size() / 7)
      for (const double turn : {0.0, 0.7, 1.9, 3.1, 4.4, 5.6}) {
        const Place on_ball{0.5 + 0.5 * std::cos(turn), 0.5 + 0.4 * std::sin(turn), 0.5 + 0.3 * std::sin(turn)};
        const Place world = moved(scene.film().matrix_at(scene.film().segments()[s], frame), on_ball);
        const Place eye = moved(to_eye, world);
        ASSERT_TRUE(swept.has_caster_round(eye)) << "segment " << s << ", frame " << frame;
        if (const auto at = pixel(eye); is_in_picture(at)) {
          ASSERT_EQ(swept.covered[static_cast<std::size_t>(at[1]) * kSweepWidth + static_cast<std::size_t>(at[0])], 1);
        }
        Place to_light{light.vector[0], light.vector[1], light.vector[2]};
        if (light.kind != wire::LightKind::directional)
          for (std::size_t axis = 0; axis < 3; ++axis) to_light[axis] -= world[axis];
        const auto shadow = shadow_of(world, to_light);
        if (!shadow) continue;
        const Place shadow_eye = moved(to_eye, *shadow);
        if (-shadow_eye[2] < p.near || !is_in_picture(pixel(shadow_eye))) continue;
        ++shadows;
        ASSERT_TRUE(swept.sweep.lines().has(static_cast<std::uint32_t>(pixel(shadow_eye)[1])))
            << "segment " << s << ", frame " << frame;
      }
  EXPECT_GT(shadows, 0u);
}

// Of each patch at each frame; where these are many, of each segment; where these are many, at several frames.
TEST(Sweep, IsRoundMovingPartsAndTheirShadows) {
  for (const wire::Light& light :
       {casting_light(wire::LightKind::directional, {-0.6f, 0, 0.8f}),
        casting_light(wire::LightKind::directional, {0.48f, -0.64f, 0.6f}),
        casting_light(wire::LightKind::point, {1, 1, 4}), casting_light(wire::LightKind::point, {-3, -2, 9})}) {
    const std::size_t patches = modeler::make_sphere().size();
    expect_bounds(circling(3, 20, light), 3 * 20 * patches, 3 * 20 * patches);
    expect_bounds(circling(60, 50, light), 60 * 50, 60 * 50);
    expect_bounds(circling(300, 100, light), 300 * 100 / 3, 1 << 14);
  }
}

// As what moves there is small, and its shadow near it.
TEST(Sweep, LeavesOutMostOfThePicture) {
  const FilmBlock block(corner(kSweepWidth, kSweepHeight, 4));
  wire::FilmData data = corner(kSweepWidth, kSweepHeight, 4);
  data.lights.front().casts = 1;
  const FilmBlock casting(data);
  for (const FilmBlock* film : {&block, &casting}) {
    geometry::Scene scene(film->view());
    scene.set_interval(0);
    const Swept swept(scene, 4);
    EXPECT_GT(swept.sweep.lines().count(), 2u);
    EXPECT_LT(swept.sweep.lines().count(), kSweepHeight / 6);
    const auto covered = static_cast<std::size_t>(std::ranges::count(swept.covered, std::uint8_t{1}));
    EXPECT_GT(covered, 8u);
    EXPECT_LT(covered, swept.covered.size() / 50);
  }
}

TEST(Sweep, WhereNothingStandsStillNothingIsCovered) {
  const wire::FilmData data = flight(kSweepWidth, kSweepHeight, 3);
  const FilmBlock block(data);
  geometry::Scene scene(block.view());
  scene.set_interval(0);
  const Swept swept(scene, 3);
  EXPECT_EQ(std::ranges::count(swept.covered, std::uint8_t{1}), 0);
  EXPECT_TRUE(swept.sweep.casters().empty());
  EXPECT_EQ(swept.sweep.lines().count(), kSweepHeight);
}

}  // namespace
}  // namespace mars::test
