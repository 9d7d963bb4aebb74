// Views of lights: how their points are spread, and that some view decides about each place.
#include "node/shadow/light_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/node/shadow/views.h"

namespace mars::shadow {

using shape::operator-;

namespace {

using shape::dot;
using shape::Random;
using shape::Vec3;

Vec3 vector_of(const float* a) { return {a[0], a[1], a[2]}; }

void expect_across(const LightView& view, double how_nearly) {
  const Vec3 u = vector_of(view.u), v = vector_of(view.v), axis = vector_of(view.axis);
  for (const Vec3& a : {u, v, axis}) EXPECT_NEAR(shape::length(a), 1, how_nearly);
  for (const double product : {dot(u, v), dot(u, axis), dot(v, axis)}) EXPECT_NEAR(product, 0, how_nearly);
}

// Points of a disc of radius 1 that is evenly bright: by rings, by sectors and on both sides of any line through its
// middle.
void expect_even(const std::vector<std::array<double, 2>>& points, double how_nearly) {
  const auto count = static_cast<double>(points.size());
  const auto share = [&](const auto& counts) {
    return static_cast<double>(std::count_if(points.begin(), points.end(), counts)) / count;
  };
  for (const auto& p : points) EXPECT_LE(std::hypot(p[0], p[1]), 1 + 1e-4);
  for (const double area : {0.125, 0.25, 0.5, 0.75}) {
    EXPECT_NEAR(share([&](const auto& p) { return p[0] * p[0] + p[1] * p[1] <= area; }), area, how_nearly);
  }
  for (int k = 0; k < 12; ++k) {
    const double c = std::cos(k * 0.5236), s = std::sin(k * 0.5236);
    for (const double t : {-0.5, 0.0, 0.5}) {
      const double part = 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / 3.14159265;
      EXPECT_NEAR(share([&](const auto& p) { return c * p[0] + s * p[1] <= t; }), part, how_nearly);
    }
  }
}

TEST(LightViews, OfADirectionalLightWithoutSizeAreOne) {
  Random random(71);
  for (int trial = 0; trial < 100; ++trial) {
    const auto light = random_light(random, wire::LightKind::directional);
    const LightViews views = light_views(light, kPicture);
    ASSERT_EQ(views.views.size(), 1u);
    EXPECT_EQ(views.points, 1u);
    EXPECT_EQ(views.spread, 0);
    expect_across(views.views[0], 1e-6);
    EXPECT_NEAR(dot(vector_of(views.views[0].axis), vector_of(light.vector.data())), 1, 1e-6);
    // A pixel at the nearest distance.
    EXPECT_NEAR(views.views[0].per_step, kPicture.scale / kPicture.near, 1e-3 * double{views.views[0].per_step});
  }
}

TEST(LightViews, OfADirectionalLightWithSizeSeeItsDisc) {
  Random random(72);
  for (int trial = 0; trial < 20; ++trial) {
    const double size = random.real(0.001, 0.5);
    const LightViews views = light_views(random_light(random, wire::LightKind::directional, size), kPicture);
    ASSERT_EQ(views.views.size(), kLightPoints);
    const Vec3 axis = vector_of(views.middle.front().axis);
    std::vector<std::array<double, 2>> disc;
    for (const LightView& view : views.views) {
      // What is on the way to a point of the disc is seen at one place.
      const Vec3 way = shape::cross(vector_of(view.u), vector_of(view.v));
      EXPECT_NEAR(dot(way, axis), 1, 1e-5);
      disc.push_back(
          {dot(way, vector_of(views.middle.front().u)) / size, dot(way, vector_of(views.middle.front().v)) / size});
    }
    expect_even(disc, 0.05);
    EXPECT_NEAR(double{views.spread}, size * double{views.middle.front().per_step}, 1e-3 * double{views.spread});
  }
}

TEST(LightViews, OfALightWithSizeSeeItsBallFromWhereverItIsSeen) {
  Random random(73);
  for (int trial = 0; trial < 20; ++trial) {
    const double size = random.real(0.01, 2);
    const auto light = random_light(random, wire::LightKind::point, size);
    const LightViews views = light_views(light, kPicture);
    ASSERT_EQ(views.views.size(), 6 * kLightPoints);
    const Vec3 way = random_way(random), other = random_way(random);
    Vec3 u = shape::cross(way, other);
    const double l = shape::length(u);
    for (double& a : u) a /= l;
    const Vec3 v = shape::cross(way, u);
    std::vector<std::array<double, 2>> disc;
    for (std::size_t k = 0; k < views.views.size(); k += 6) {
      const Vec3 from = vector_of(views.views[k].place) - vector_of(light.vector.data());
      disc.push_back({dot(from, u) / size, dot(from, v) / size});
    }
    expect_even(disc, 0.11);
  }
}

// How many views decide about a place.
int deciding(const LightViews& views, const Vec3& place) {
  int count = 0;
  for (const LightView& view : views.views) {
    const Vec3 from = place - vector_of(view.place);
    const double depth = along(view.axis, from);
    if (depth < double{view.nearest}) continue;
    const bool own = std::abs(along(view.u, from)) <= depth && std::abs(along(view.v, from)) <= depth;
    count += !view.is_face || own;
  }
  return count;
}

TEST(LightViews, OfALightWithAPlaceDecideAboutAllPlacesItShinesAt) {
  Random random(74);
  int one = 0;
  for (int trial = 0; trial < 100; ++trial) {
    auto light = random_light(random, trial % 2 ? wire::LightKind::point : wire::LightKind::spot);
    light.cos_outer = static_cast<float>(random.real(-0.9, 0.99));
    const LightViews views = light_views(light, kPicture);
    EXPECT_EQ(views.views.size(), views.faces);
    for (const LightView& view : views.views) {
      expect_across(view, 1e-6);
      EXPECT_EQ(vector_of(view.place), vector_of(light.vector.data()));
    }
    one += views.faces == 1;
    for (int k = 0; k < 100; ++k) {
      const Vec3 way = random_way(random), middle = vector_of(light.vector.data());
      const double far = random.real(0.1, 50);
      const Vec3 place{middle[0] + far * way[0], middle[1] + far * way[1], middle[2] + far * way[2]};
      const bool lit = light.kind == wire::LightKind::point ||
                       dot(way, vector_of(light.axis.data())) > double{light.cos_outer} + 1e-4;
      if (lit) {
        ASSERT_GE(deciding(views, place), 1) << trial;
      }
    }
  }
  EXPECT_GT(one, 3);
}

// The grid has no more steps than floats and whole numbers of 32 bits take, and points are bounded by two of them.
TEST(LightViews, StepsFitTheFarthestPlaces) {
  auto light = geometry::EyeLight{wire::LightKind::directional, {0.6f, 0, 0.8f}, {1, 1, 1}};
  light.casts = 1;
  const shape::Projection wide = shape::projection(4000, 3000, 2, 0.001, 1e6);
  const LightViews views = light_views(light, wide);
  const double farthest = double{wide.far} / double{wide.corner};
  EXPECT_LE(farthest * double{views.middle.front().per_step}, 1 << 29);
  EXPECT_GE(double{views.frame.everywhere}, 2 / double{views.middle.front().per_step} * 0.999);
}

}  // namespace
}  // namespace mars::shadow
