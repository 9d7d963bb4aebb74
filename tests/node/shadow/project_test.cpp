// Places on grids: plain code's bits from every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/node/shadow/views.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shadow {
namespace {

using shape::Random;

constexpr float kMostOnGrid = 1 << 29;

struct Seen {
  float x, y, z, across_u, across_v, depth;
  bool before, on_grid;
};

float dot(const float* a, float x, float y, float z) { return (a[0] * x + a[1] * y) + a[2] * z; }

Seen see(const LightView& view, float x, float y, float z) {
  if (view.has_place) x -= view.place[0], y -= view.place[1], z -= view.place[2];
  Seen seen{};
  seen.depth = dot(view.axis, x, y, z), seen.across_u = dot(view.u, x, y, z), seen.across_v = dot(view.v, x, y, z);
  seen.x = seen.across_u, seen.y = seen.across_v, seen.z = seen.depth;
  seen.before = !std::isnan(seen.depth);
  if (view.has_place) {
    seen.before = seen.depth >= view.nearest;
    seen.z = 1.0f / seen.depth;
    seen.x *= seen.z, seen.y *= seen.z;
  }
  seen.x *= view.per_step, seen.y *= view.per_step;
  seen.on_grid = seen.before && std::abs(seen.x) <= kMostOnGrid && std::abs(seen.y) <= kMostOnGrid;
  return seen;
}

std::int32_t on_grid(float place) { return static_cast<std::int32_t>(std::nearbyint(place)); }

struct Bounds {
  GridBox box{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min(),
              std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min(),
              std::numeric_limits<float>::max(),        -std::numeric_limits<float>::max()};
  void add(std::int32_t x, std::int32_t y, float z) {
    box = {std::min(box.low_x, x),  std::max(box.high_x, x), std::min(box.low_y, y),
           std::max(box.high_y, y), std::min(box.low_z, z),  std::max(box.high_z, z)};
  }
};

void expect_same(const GridBox& a, const GridBox& b) {
  EXPECT_EQ(a.low_x, b.low_x);
  EXPECT_EQ(a.high_x, b.high_x);
  EXPECT_EQ(a.low_y, b.low_y);
  EXPECT_EQ(a.high_y, b.high_y);
  EXPECT_EQ(a.low_z, b.low_z);
  EXPECT_EQ(a.high_z, b.high_z);
}

// Of any kind, hard or not.
LightViews random_views(Random& random) {
  const auto kind = static_cast<wire::LightKind>(random.whole(0, 2));
  return light_views(random_light(random, kind, random.whole(0, 1) ? 0.3 : 0), kPicture);
}

// Now and then before the light by as little as it may be, or far out.
void put_place(Random& random, const LightView& view, float (&place)[3]) {
  const double most = std::pow(10, random.real(-1, random.whole(0, 9) ? 1.5 : 6));
  for (float& axis : place) axis = static_cast<float>(random.real(-most, most));
  if (random.whole(0, 9) == 0 && view.has_place)
    for (std::size_t k = 0; k < 3; ++k)
      place[k] = view.place[k] + view.axis[k] * view.nearest * static_cast<float>(1 + random.whole(-2, 2) * 1e-6);
}

TEST(Project, IsPlainCodesEverywhere) {
  Random random(51);
  int off = 0, near = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const LightViews views = random_views(random);
    const LightView& view = views.views[static_cast<std::size_t>(random.whole(0, int(views.views.size()) - 1))];
    const auto count = static_cast<std::uint32_t>(random.whole(1, 70));
    std::vector<float> place[3];
    for (auto& axis : place) axis.resize(count + simd::kVectorSlack, 1);
    Bounds bounds;
    bool any_off = false, any_before = false;
    std::vector<Seen> plain;
    const bool crowded = random.whole(0, 1) == 1;
    for (std::uint32_t k = 0; k < count; ++k) {
      float at[3];
      put_place(random, view, at);
      if (crowded && k > 0)  // so that all are on the grid
        for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = place[axis][0] + 1e-3f * at[axis];
      for (std::size_t axis = 0; axis < 3; ++axis) place[axis][k] = at[axis];
      plain.push_back(see(view, at[0], at[1], at[2]));
      any_before |= plain[k].before;
      any_off |= !plain[k].on_grid;
      if (plain[k].on_grid) bounds.add(on_grid(plain[k].x), on_grid(plain[k].y), plain[k].z);
    }
    off += any_off && any_before, near += !any_off;
    const float* const places[3] = {place[0].data(), place[1].data(), place[2].data()};
    for (const simd::InstructionSet set : simd::all_sets()) {
      SCOPED_TRACE(simd::name_of(set));
      Grid grid(count);
      const GridBox box = shadow_kernels(set).project(view, places, count, grid.vertices());
      for (std::uint32_t k = 0; k < count; ++k) {
        ASSERT_EQ(grid.x[k], plain[k].on_grid ? on_grid(plain[k].x) : kOffGrid);
        ASSERT_EQ(grid.y[k], plain[k].on_grid ? on_grid(plain[k].y) : kOffGrid);
        if (plain[k].on_grid) {
          ASSERT_EQ(grid.z[k], plain[k].z);
        }
      }
      if (!any_before) {
        EXPECT_GT(box.low_x, box.high_x);
      } else if (any_off) {
        EXPECT_LE(box.low_x, -kMostOnGrid);
        EXPECT_GE(box.high_x, kMostOnGrid);
        EXPECT_EQ(box.high_z, std::numeric_limits<float>::max());
      } else {
        expect_same(box, bounds.box);
      }
    }
  }
  EXPECT_GT(off, 50);
  EXPECT_GT(near, 50);
}

// One vector of a square.
struct Places {
  float left, top;
  LanePlaces lanes;
  alignas(64) float inverse_w[kPointLanes];
};

Places random_places(Random& random) {
  Places places;
  const double away = std::pow(10, random.real(-1, 2));
  places.left = static_cast<float>(8 * random.whole(0, 24)), places.top = static_cast<float>(8 * random.whole(0, 18));
  for (std::size_t k = 0; k < kPointLanes; ++k) {
    places.lanes.x[k] = static_cast<float>(random.whole(0, 2047) / 256.0);
    places.lanes.y[k] = static_cast<float>(random.whole(0, 2047) / 256.0);
    places.inverse_w[k] = random.whole(0, 5) ? static_cast<float>(1 / (away * random.real(1, 1.1))) : 0;
  }
  return places;
}

TEST(PutPoints, IsPlainCodesEverywhere) {
  Random random(52);
  int inactive = 0, active = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const LightViews views = random_views(random);
    const LightView& view = views.views[static_cast<std::size_t>(random.whole(0, int(views.views.size()) - 1))];
    const PointFrame& frame = views.frame;
    const Places at = random_places(random);
    const std::uint32_t asked = random.bits() & 0xffff;
    PointVector plain{};
    Bounds bounds;
    for (std::size_t k = 0; k < kPointLanes; ++k) {
      const float w = 1.0f / at.inverse_w[k], per_pixel = 1.0f / frame.scale;
      const float x = at.left + at.lanes.x[k], y = at.top + at.lanes.y[k];
      const float px = ((x - frame.center[0]) * per_pixel) * w, py = ((frame.center[1] - y) * per_pixel) * w;
      const Seen seen = see(view, px, py, -w);
      const bool own =
          !view.is_face || (std::abs(seen.across_u) <= seen.depth && std::abs(seen.across_v) <= seen.depth);
      plain.x[k] = plain.y[k] = kOffGrid;
      if (!(asked >> k & 1) || !(at.inverse_w[k] > 0) || !seen.on_grid || !own) continue;
      plain.active |= 1u << k;
      plain.x[k] = on_grid(seen.x), plain.y[k] = on_grid(seen.y), plain.z[k] = seen.z;
      plain.error[k] = (w * frame.by_square + frame.by_w) * w + frame.everywhere;
      if (view.has_place) plain.error[k] = (plain.error[k] + seen.depth * frame.by_depth) * seen.z;
      bounds.add(plain.x[k], plain.y[k], plain.z[k]);
    }
    inactive += plain.active != asked, active += plain.active != 0;
    for (const simd::InstructionSet set : simd::all_sets()) {
      SCOPED_TRACE(simd::name_of(set));
      PointVector points;
      shadow_kernels(set).put_points(view, frame, at.left, at.top, at.lanes, at.inverse_w, asked, points);
      ASSERT_EQ(points.active, plain.active);
      ASSERT_EQ(points.blocked, 0u);
      for (std::size_t k = 0; k < kPointLanes; ++k) {
        if (!(plain.active >> k & 1)) continue;
        ASSERT_EQ(points.x[k], plain.x[k]);
        ASSERT_EQ(points.y[k], plain.y[k]);
        ASSERT_EQ(points.z[k], plain.z[k]);
        ASSERT_EQ(points.error[k], plain.error[k]);
      }
      if (plain.active != 0) expect_same(points.box, bounds.box);
    }
  }
  EXPECT_GT(inactive, 500);
  EXPECT_GT(active, 500);
}

}  // namespace
}  // namespace mars::shadow
