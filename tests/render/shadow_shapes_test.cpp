// Shadows whose shapes formulas give: a sphere's is an ellipse, a penumbra is as wide as the light is large, a lamp's
// shadow grows; what stands on a floor meets its shadow, and what is lit has no speck of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"
#include "tests/render/shadow_rig.h"

namespace mars::test {
namespace {

using shape::cross;
using shape::dot;
using shape::length;
using shape::operator-;
using shape::Random;

// The floor reflects what falls on it, and a fifth of it from all around; casters are black.
constexpr wire::Material kFloor{{1, 1, 1}, 0.2f, 0.6f, 0, 1, 2};
constexpr wire::Material kBlack{{0, 0, 0}, 0, 0, 0, 1, 2};
constexpr double kAmbient = 0.2, kDiffuse = 0.6;

Vec3 along(const Vec3& from, const Vec3& way, double far) {
  return {from[0] + far * way[0], from[1] + far * way[1], from[2] + far * way[2]};
}

Vec3 unit_vector(const Vec3& a) { return along({0, 0, 0}, a, 1 / length(a)); }

std::array<float, 3> floats(const Vec3& a) {
  return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

// The unit square at z = 0.
std::vector<wire::Patch> sheet() {
  wire::Patch patch;
  for (std::size_t k = 0; k < 16; ++k)
    patch.points[k] = {static_cast<float>(k % 4) / 3, static_cast<float>(k / 4) / 3, 0};
  return {patch};
}

wire::Matrix stretched(const Vec3& place, const Vec3& size) {
  return {{{{size[0], 0, 0, place[0]}, {0, size[1], 0, place[1]}, {0, 0, size[2], place[2]}}}};
}

wire::Light directional(const Vec3& to_light, double size = 0) {
  wire::Light light{wire::LightKind::directional, floats(unit_vector(to_light)), {1, 1, 1}};
  light.casts = 1;
  light.size = static_cast<float>(size);
  return light;
}

wire::Light point(const Vec3& place, double size = 0) {
  wire::Light light{wire::LightKind::point, floats(place), {1, 1, 1}};
  light.casts = 1;
  light.size = static_cast<float>(size);
  return light;
}

// From `eye` straight down, x to the right and y up.
wire::Camera looking_down(const Vec3& eye, double fov) {
  wire::Camera camera{{}, 1 / std::tan(fov * std::numbers::pi / 360), 0.05, 1000};
  for (std::size_t r = 0; r < 3; ++r) {
    camera.world_to_eye.m[r] = {0, 0, 0, -eye[r]};
    camera.world_to_eye.m[r][r] = 1;
  }
  return camera;
}

// A picture of one frame, and where its pixels look.
class View {
 public:
  View(const wire::FilmData& film)
      : settings_(film.settings),
        camera_(film.cameras.front()),
        pixels_(run_film(FilmBlock(film).bytes()).frames.at(0)) {
    const auto& m = camera_.world_to_eye.m;
    for (std::size_t k = 0; k < 3; ++k) eye_[k] = -(m[0][k] * m[0][3] + m[1][k] * m[1][3] + m[2][k] * m[2][3]);
  }
  std::uint32_t width() const { return settings_.width; }
  std::uint32_t height() const { return settings_.height; }
  const Vec3& eye() const { return eye_; }
  // Pixels from the left and from the top.
  Vec3 way(double x, double y) const {
    const double scale = camera_.focal * height() / 2;
    const Vec3 e{(x - width() / 2.0) / scale, (height() / 2.0 - y) / scale, -1};
    const auto& m = camera_.world_to_eye.m;
    return {m[0][0] * e[0] + m[1][0] * e[1] + m[2][0] * e[2], m[0][1] * e[0] + m[1][1] * e[1] + m[2][1] * e[2],
            m[0][2] * e[0] + m[1][2] * e[1] + m[2][2] * e[2]};
  }
  // Of the floor, z = 0.
  Vec3 floor(double x, double y) const {
    const Vec3 to = way(x, y);
    return along(eye_, to, -eye_[2] / to[2]);
  }
  // 0..1, red.
  double light(std::uint32_t x, std::uint32_t y) const { return (pixels_[y * width() + x] & 255) / 255.0; }
  bool shows_floor(std::uint32_t x, std::uint32_t y) const { return light(x, y) > 0.1; }

 private:
  wire::FilmSettings settings_;
  wire::Camera camera_;
  Pixels pixels_;
  Vec3 eye_{};
};

// What a place of a pixel shows: some number of a surface, and whether it is in shadow; the same all over a pixel and a
// bit round it, or nothing.
using Shows = std::function<int(double x, double y)>;

std::optional<int> shown(const Shows& shows, std::uint32_t column, std::uint32_t row) {
  constexpr double kReach = 1.0;
  const int middle = shows(column + 0.5, row + 0.5);
  for (const double dx : {-kReach, 0.0, kReach})
    for (const double dy : {-kReach, 0.0, kReach})
      if (shows(column + 0.5 + dx, row + 0.5 + dy) != middle) return {};
  return middle;
}

// A floor and one caster over it.
wire::FilmData over_floor(const std::vector<wire::Patch>& caster, const wire::Matrix& where, const wire::Light& light,
                          const wire::Camera& camera, std::uint32_t samples = 1) {
  FilmMaker maker(160, 120, 1);
  maker.add_segment(maker.add_shape(sheet()), maker.add_material(kFloor), {stretched({-30, -30, 0}, {60, 60, 1})});
  maker.add_segment(maker.add_shape(caster), maker.add_material(kBlack), {where});
  maker.add_light(light);
  maker.set_cameras({camera});
  return with_samples(maker.make(), samples);
}

TEST(Shadows, OfASphereAreTheEllipse) {
  constexpr double kRadius = 0.7;
  for (const double turn : {0.3, 2.0, 4.4}) {
    const Vec3 middle{0.4, -0.3, 2}, to_light = unit_vector({std::cos(turn), std::sin(turn), 0.8});
    const View view(over_floor(modeler::make_sphere(), placed(along(middle, {1, 1, 1}, -kRadius), 2 * kRadius),
                               directional(to_light), looking_down({0, 0, 12}, 45)));
    const Shows shows = [&](double x, double y) {
      return length(cross(middle - view.floor(x, y), to_light)) < kRadius ? 1 : 0;
    };
    const Shows sees_sphere = [&](double x, double y) {
      return length(cross(middle - view.eye(), unit_vector(view.way(x, y)))) < kRadius ? 1 : 0;
    };
    int dark = 0, all_dark = 0, compared = 0;
    for (std::uint32_t y = 0; y < view.height(); ++y)
      for (std::uint32_t x = 0; x < view.width(); ++x) {
        if (shown(sees_sphere, x, y) != 0) continue;
        const bool is_dark = view.light(x, y) < kAmbient + 0.05;
        all_dark += is_dark;
        const std::optional<int> expected = shown(shows, x, y);
        if (!expected) continue;
        ++compared;
        dark += *expected;
        ASSERT_EQ(is_dark, *expected == 1) << x << ' ' << y;
        ASSERT_NEAR(view.light(x, y), kAmbient + (is_dark ? 0 : kDiffuse * to_light[2]), 1.5 / 255);
      }
    EXPECT_GT(compared, 17000);
    EXPECT_GT(dark, 100);
    const double pixel = length(view.floor(1, 0) - view.floor(0, 0));
    const double area = std::numbers::pi * kRadius * kRadius / to_light[2] / (pixel * pixel);
    EXPECT_NEAR(all_dark, area, 0.04 * area);
  }
}

// Of an evenly bright disc, what is on one side of a line at `t` radii from its middle.
double part_of_disc(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi;
}

// Shares of the light, and what they should be, by places along x: means over a strip of pixels each.
struct Profile {
  explicit Profile(double strip) : strip_(strip) {}
  void add(double x, double share, double expected) {
    Sum& sum = strips_[static_cast<int>(std::floor(x / strip_))];
    sum.share += share, sum.expected += expected, sum.count += 1;
  }
  void expect_within(double most) const {
    int some = 0;
    for (const auto& [number, sum] : strips_) {
      if (sum.count < 100) continue;
      EXPECT_NEAR(sum.share / sum.count, sum.expected / sum.count, most) << number * strip_;
      some += sum.expected > 0.02 * sum.count && sum.expected < 0.98 * sum.count;
    }
    EXPECT_GT(some, 8);
    for (const double share : {0.02, 0.5, 0.98})
      EXPECT_NEAR(first_above(&Sum::share, share), first_above(&Sum::expected, share), 1.5 * strip_) << share;
  }

 private:
  struct Sum {
    double share = 0, expected = 0, count = 0;
  };
  double first_above(double Sum::*number, double share) const {
    const auto at = std::find_if(strips_.begin(), strips_.end(), [&](const auto& strip) {
      return strip.second.count >= 100 && strip.second.*number > share * strip.second.count;
    });
    return at == strips_.end() ? 1e9 : at->first * strip_;
  }

  double strip_;
  std::map<int, Sum> strips_;
};

// Of a sheet whose edge lies `edge` above the line x = 0 of the floor. `lit`: what the light adds where all of it
// arrives, `share`: how much arrives, by the formula.
void expect_penumbra(const wire::Light& light, double edge, double width, std::uint32_t samples,
                     const std::function<double(const Vec3&)>& lit, const std::function<double(double)>& share) {
  const Vec3 eye{4, -5, 9};
  const double fov = 360 / std::numbers::pi * std::atan(width / length(eye));
  const View view(
      over_floor(sheet(), stretched({-6, -10, edge}, {6, 20, 1}), light, looking(eye, {0, 0, 0}, fov), samples));
  Profile profile(width / 12);
  for (std::uint32_t y = 0; y < view.height(); ++y)
    for (std::uint32_t x = 0; x < view.width(); ++x) {
      if (!view.shows_floor(x, y)) continue;
      const Vec3 at = view.floor(x + 0.5, y + 0.5);
      profile.add(at[0], (view.light(x, y) - kAmbient) / lit(at), share(at[0]));
    }
  profile.expect_within(light.kind == wire::LightKind::directional ? 0.02 : 0.03);
}

TEST(Shadows, OfAnEdgeInADirectionalLightAreAsWideAsItsAngle) {
  for (const std::uint32_t samples : {1u, 4u, 16u})
    for (const double size : {0.05, 0.3}) {
      SCOPED_TRACE(std::to_string(samples) + " samples, size " + std::to_string(size));
      // Straight from above, over an edge one above the floor.
      expect_penumbra(
          directional({0, 0, 1}, size), 1, 2 * size, samples, [](const Vec3&) { return kDiffuse; },
          [&](double x) { return part_of_disc(x / size); });
    }
}

TEST(Shadows, OfAnEdgeInALampAreAsWideAsItsBall) {
  constexpr double kHigh = 6, kEdge = 2;
  for (const std::uint32_t samples : {1u, 4u, 16u})
    for (const double radius : {0.1, 0.8}) {
      SCOPED_TRACE(std::to_string(samples) + " samples, radius " + std::to_string(radius));
      // By how far the ball's middle is from the plane through the edge and the place.
      expect_penumbra(
          point({0, 0, kHigh}, radius), kEdge, 2 * radius * kEdge / (kHigh - kEdge), samples,
          [&](const Vec3& at) {
            return kDiffuse * kHigh / length(Vec3{0, 0, kHigh} - at);
          },
          [&](double x) { return part_of_disc(x * (kHigh - kEdge) / std::hypot(x, kEdge) / radius); });
    }
}

TEST(Shadows, OfALampGrow) {
  constexpr double kSide = 1, kEdge = 2;
  for (const double high : {3.0, 6.0, 20.0})
    for (const auto kind : {wire::LightKind::point, wire::LightKind::spot}) {
      const Vec3 lamp{0.3, -0.2, high};
      wire::Light light = point(lamp);
      light.kind = kind;
      light.axis = {0, 0, -1};
      light.cos_inner = 0.5f, light.cos_outer = 0.4f;
      const View view(over_floor(sheet(), stretched({-kSide / 2, -kSide / 2, kEdge}, {kSide, kSide, 1}), light,
                                 looking_down({3, 0, 12}, 35)));
      const double grown = high / (high - kEdge);
      const Shows shows = [&](double x, double y) {
        const Vec3 at = view.floor(x, y);
        const auto within = [&](std::size_t k) {
          return std::abs(at[k] - (lamp[k] - lamp[k] * grown)) < kSide / 2 * grown;
        };
        return within(0) && within(1) ? 1 : 0;
      };
      int dark = 0;
      for (std::uint32_t y = 0; y < view.height(); ++y)
        for (std::uint32_t x = 0; x < view.width(); ++x) {
          const std::optional<int> expected = shown(shows, x, y);
          if (!expected || !view.shows_floor(x, y)) continue;
          const double cosine = high / length(lamp - view.floor(x + 0.5, y + 0.5));
          if (kind == wire::LightKind::spot && cosine < 0.51) continue;
          dark += *expected;
          ASSERT_NEAR(view.light(x, y), kAmbient + (*expected ? 0 : kDiffuse * cosine), 2.0 / 255) << x << ' ' << y;
        }
      EXPECT_GT(dark, 100) << high;
    }
}

// A box that stands on the floor at the origin, turned.
struct Box {
  double size, angle;

  Vec3 to_own(const Vec3& a) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {(c * a[0] + s * a[1]) / size, (c * a[1] - s * a[0]) / size, a[2] / size};
  }
  wire::Matrix matrix() const {
    const double c = std::cos(angle), s = std::sin(angle);
    return placed({(s - c) * size / 2, -(s + c) * size / 2, 0}, size, angle);
  }
  struct Hit {
    double far = std::numeric_limits<double>::max();
    int face = -1;  // 2 * axis, + 1 for the upper one
  };
  // From outside, along `way`.
  Hit meet(const Vec3& from, const Vec3& way) const {
    const Vec3 low{-0.5, -0.5, 0}, p = to_own(from), d = to_own(way);
    double enter = -1e30, leave = 1e30;
    int face = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = (low[k] - p[k]) / d[k], b = (low[k] + 1 - p[k]) / d[k];
      if (std::min(a, b) > enter) enter = std::min(a, b), face = static_cast<int>(2 * k + (b < a ? 1 : 0));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave && enter > 1e-9 ? Hit{enter, face} : Hit{};
  }
  Vec3 normal(int face) const {
    const double sign = face % 2 ? 1 : -1, c = std::cos(angle), s = std::sin(angle);
    if (face / 2 == 0) return {sign * c, sign * s, 0};
    return face / 2 == 1 ? Vec3{-sign * s, sign * c, 0} : Vec3{0, 0, sign};
  }
};

constexpr wire::Material kBrick{{0.5f, 0, 0}, 0.2f, 0.6f, 0, 1, 1};

TEST(Shadows, OfABoxMeetItsFeetAndLeaveItsLitSidesAlone) {
  const Vec3 lights[] = {{1, 0.4, 1}, {-0.9, 1, 0.5}, {0.2, 1, 0.15}, {0.5, -1, 3}, {-1, -0.3, 0.05}};
  int feet = 0;
  for (const double size : {1.0, 1e-3, 1e4})
    for (const Vec3& to : lights) {
      SCOPED_TRACE("size " + std::to_string(size) + ", light along " + std::to_string(to[0]));
      const Box box{size, 0.4 + to[1]};
      const Vec3 to_light = unit_vector(to);
      FilmMaker maker(120, 90, 1);
      maker.add_segment(maker.add_shape(sheet()), maker.add_material(kFloor),
                        {stretched({-20 * size, -20 * size, 0}, {40 * size, 40 * size, 1})});
      maker.add_segment(maker.add_shape(modeler::make_box()), maker.add_material(kBrick), {box.matrix()});
      maker.add_light(directional(to_light));
      maker.set_cameras({looking({2.2 * size, -3 * size, 2 * size}, {0, 0, 0.3 * size}, 35, 0.05 * size, 1000 * size)});
      const View view(maker.make());
      // 0: lit floor, 1: floor in shadow, 2 and more: the box's faces.
      const Shows shows = [&](double x, double y) {
        const Vec3 way = view.way(x, y);
        const Box::Hit hit = box.meet(view.eye(), way);
        const double floor = way[2] < 0 ? -view.eye()[2] / way[2] : std::numeric_limits<double>::max();
        if (hit.face >= 0 && hit.far < floor) return 2 + hit.face;
        return floor > 1e6 ? -1 : box.meet(view.floor(x, y), to_light).face >= 0 ? 1 : 0;
      };
      for (std::uint32_t y = 0; y < view.height(); ++y)
        for (std::uint32_t x = 0; x < view.width(); ++x) {
          const std::optional<int> expected = shown(shows, x, y);
          if (!expected || *expected < 0) continue;
          const double cosine = *expected < 2 ? to_light[2] : std::max(0.0, dot(box.normal(*expected - 2), to_light));
          const double light = (*expected < 2 ? 1 : 0.5) * (kAmbient + (*expected == 1 ? 0 : kDiffuse * cosine));
          ASSERT_NEAR(view.light(x, y), light, 2.0 / 255) << x << ' ' << y << " shows " << *expected;
          if (*expected == 1) {  // two pixels from the box
            const int below = shows(x + 0.5, y - 2.0);
            feet += below >= 2 ? 1 : 0;
          }
        }
    }
  EXPECT_GT(feet, 100);
}

// A film whose one shape has lights from many ways.
wire::FilmData alone(const std::vector<wire::Patch>& patches, const wire::Matrix& where, const wire::Light& light,
                     const wire::Camera& camera, std::uint32_t samples, std::uint32_t dice) {
  FilmMaker maker(40, 30, 1);
  maker.add_segment(maker.add_shape(patches), maker.add_material(kFloor), {where});
  maker.add_light(light);
  maker.set_cameras({camera});
  wire::FilmData film = with_samples(maker.make(), samples);
  film.settings.dice = dice;
  return film;
}

std::size_t count_blocked(const ShadowRig& rig, std::size_t* all) {
  const std::vector<Pair> pairs = rig.pairs();
  *all += pairs.size();
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.blocked; }));
}

// A floor up to the horizon, with the eye near it, from before the picture to far behind it.
struct Floor {
  double eye, across;  // heights of the eye, and lengths of the floor
  double near, far;    // of the camera
};

void expect_nothing_blocked(std::span<const Floor> floors) {
  Random random(801);
  std::size_t all = 0;
  for (const Floor& floor : floors)
    for (const double height : {1.0, 0.1, 1e-2, 1e-3, 1e-5, -0.3})
      for (int trial = 0; trial < 4; ++trial) {
        const double turn = random.real(0, 6.28), angle = random.real(0, 1);
        const double size = trial % 2 ? 0.05 : 0;
        const wire::Light light =
            trial < 2 ? directional({std::cos(turn), std::sin(turn), height}, size)
                      : point({5 * floor.eye * std::cos(turn), 5 * floor.eye * std::sin(turn), 5 * floor.eye * height},
                              size * floor.eye * std::abs(height));
        wire::Matrix where = placed({0, 0, 0}, floor.across, angle);
        for (std::size_t r = 0; r < 2; ++r) where.m[r][3] = -(where.m[r][0] + where.m[r][1]) / 2;
        const wire::Camera camera =
            looking({0, 0, floor.eye}, {3 * floor.eye, floor.eye, 0.6 * floor.eye}, 50, floor.near, floor.far);
        const ShadowRig rig(alone(sheet(), where, light, camera, trial == 1 ? 4 : 1, trial == 0 ? 0 : 9));
        const std::size_t blocked = count_blocked(rig, &all);
        EXPECT_EQ(blocked, 0u) << "eye " << floor.eye << ", across " << floor.across << ", light " << height
                               << ", trial " << trial;
      }
  EXPECT_GT(all, 50000u);
}

TEST(Shadows, OfAFloorDoNotFallOnIt) {
  constexpr Floor kFloors[] = {
      {1.7, 60, 0.05, 1000}, {0.2, 1e4, 0.05, 2e4}, {1e4, 1e5, 10, 1e6}, {1e-3, 0.05, 1e-4, 1}};
  expect_nothing_blocked(kFloors);
}

// Their triangles are cut where they leave the guard band, far from the picture.
TEST(Shadows, OfALargeFloorDoNotFallOnIt) {
  constexpr Floor kFloors[] = {{1.7, 2000, 0.05, 5000}, {20, 1e4, 0.1, 1e5}};
  expect_nothing_blocked(kFloors);
}

TEST(Shadows, OfASphereLieOnItsDarkSideAlone) {
  Random random(802);
  std::size_t lit = 0, dark = 0;
  for (const double radius : {0.5, 1e4, 1e-3})
    for (const double away : {3.0, 30.0})
      for (int trial = 0; trial < 6; ++trial) {
        const Vec3 way{random.real(-1, 1), random.real(-1, 1), random.real(-0.5, 1)};
        const wire::Light light =
            trial % 2 ? directional(way) : point(along({0, 0, 0}, unit_vector(way), 2.5 * radius));
        const wire::Camera camera = looking({0.3 * away * radius, -away * radius, 0.5 * away * radius}, {0, 0, 0},
                                            trial < 3 ? 70 / away : 150 / away, 0.05 * radius, 1000 * radius);
        const ShadowRig rig(alone(modeler::make_sphere(), placed({-radius, -radius, -radius}, 2 * radius), light,
                                  camera, trial % 3 ? 4 : 1, trial == 5 ? 10 : 0));
        const geometry::EyeLight& eye_light = rig.scene().casting_lights()[0];
        const shape::EyeMatrix m = rig.scene().matrix(0);
        const auto middle = [&](std::size_t r) { return (m.m[r][0] + m.m[r][1] + m.m[r][2]) / 2.0 + m.m[r][3]; };
        for (const Pair& pair : rig.pairs()) {
          const Vec3 normal = unit_vector(pair.place - Vec3{middle(0), middle(1), middle(2)});
          Vec3 to_light{eye_light.vector[0], eye_light.vector[1], eye_light.vector[2]};
          if (light.kind == wire::LightKind::point) to_light = to_light - pair.place;
          const double cosine = dot(normal, unit_vector(to_light));
          if (std::abs(cosine) < 0.3) continue;  // facets
          ++(cosine > 0 ? lit : dark);
          ASSERT_EQ(pair.blocked, cosine < 0)
              << "radius " << radius << ", away " << away << ", trial " << trial << ", cosine " << cosine;
        }
      }
  EXPECT_GT(lit, 2000u);
  EXPECT_GT(dark, 2000u);
}

}  // namespace
}  // namespace mars::test
