// Surfaces shaded once a vertex or once a triangle: the twin's light there, carried to the samples, clipped or not.
#include "node/shading/colored_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "node/shape/dice.h"
#include "tests/node/raster/set_ups.h"
#include "tests/node/shading/vertex_light.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shading {

using shape::dot;
using shape::Vec3;
using shape::operator-;

namespace {

constexpr std::int32_t kWidth = 640, kHeight = 480;
constexpr double kNear = 0.5;

simd::InstructionSet best() { return simd::best_instruction_set(""); }

// An eighth of a sphere as the eye sees it, with a light.
struct Ball {
  Frame frame;
  shape::Dicer dicer{best()};
  ColoredSurface colored{best()};

  explicit Ball(int rate = 12, double radius = 1, double distance = 4) {
    frame.shading.projection = shape::projection(kWidth, kHeight, 2, kNear);
    frame.material = {{1, 0.5f, 0.2f}, 0.2f, 0.8f, 0.5f, 8, 2};
    geometry::EyeLight light{};
    light.kind = wire::LightKind::point;
    light.vector[0] = light.vector[1] = 3;
    for (float& color : light.color) color = 1;
    frame.lights = {light};
    dicer.dice(shape::sphere_octant({0, 0, -distance}, radius), frame.shading.projection,
               {.fixed_rate = rate, .tolerances = {}});
  }
  Coloring coloring() { return {frame.view(), 0, true, true}; }
  Vec3 place(std::uint32_t k) const { return of(dicer.vertices().place, k); }
  Vec3 normal(std::uint32_t k) const { return of(dicer.vertices().normal, k); }
  Vec3 light_at(const Vec3& place, const Vec3& normal) {
    return plain_light(frame.view(), frame.material, {place, normal});
  }

 private:
  static Vec3 of(float* const* arrays, std::uint32_t k) { return {arrays[0][k], arrays[1][k], arrays[2][k]}; }
};

Vec3 color_of(const shape::VertexColors& colors, std::uint32_t k) {
  return {colors.color[0][k], colors.color[1][k], colors.color[2][k]};
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

TEST(ColoredSurface, VerticesAreLitFromBothSides) {
  Ball ball;
  const shape::Surface& surface = ball.colored.by_vertices(ball.dicer, ball.coloring());
  ASSERT_EQ(surface.vertex_count(), ball.dicer.vertex_count());
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(surface.vertex_count()); ++k) {
    const Vec3 place = ball.place(k), normal = ball.normal(k);
    expect_near(color_of(surface.vertices().colors[0], k), ball.light_at(place, normal), 1e-5);
    expect_near(color_of(surface.vertices().colors[1], k), ball.light_at(place, Vec3{} - normal), 1e-5);
  }
}

// Rates that give more triangles than fit at once, too.
TEST(ColoredSurface, TrianglesAreLitInTheirMiddle) {
  for (const int rate : {5, 40}) {
    Ball ball(rate);
    const shape::Triangles& triangles = ball.dicer.triangles();
    std::uint32_t seen = 0;
    for (std::uint32_t first = 0; first < triangles.count; first += ColoredSurface::kFlatTriangles) {
      const shape::Surface& surface = ball.colored.by_triangles(ball.dicer, first, ball.coloring());
      for (std::uint32_t k = 0; k < surface.triangles().count; ++k, ++seen) {
        const shape::Corner3 corners = triangles[first + k];
        const Vec3 a = ball.place(corners.a), b = ball.place(corners.b), c = ball.place(corners.c);
        Vec3 middle;
        for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (a[axis] + b[axis] + c[axis]) / 3;
        Vec3 normal = shape::cross(b - a, c - a);
        const double size = shape::length(normal) * (dot(normal, middle) > 0 ? -1 : 1);
        if (std::abs(size) < 1e-6) continue;  // at the pole
        for (double& n : normal) n /= size;
        const shape::Corner3 own = surface.triangles()[k];
        for (const std::uint32_t corner : {own.a, own.b, own.c})
          expect_near(color_of(surface.vertices().colors[0], corner), ball.light_at(middle, normal), 1e-3);
      }
    }
    EXPECT_EQ(seen, triangles.count);
  }
}

// All samples of all set-ups, against bounds of the surface's colours.
void expect_within_colors(Ball& ball, const shape::Surface& surface, bool one_color) {
  const raster::Made made =
      raster::set_up(best(), {ball.frame.shading.projection, kWidth, kHeight}, surface, {7, 0, false, false, false});
  ASSERT_GT(made.triangles.size(), 5u);
  double low = 1e9, high = -1e9;
  for (std::uint32_t k = 0; k < surface.triangles().count; ++k)
    for (const std::uint32_t corner : {surface.triangles()[k].a, surface.triangles()[k].b, surface.triangles()[k].c})
      for (int side = 0; side < 2; ++side) {
        const double red = surface.vertices().colors[side].color[0][corner];
        low = std::min(low, red), high = std::max(high, red);
      }
  ball.frame.material.interpolation = one_color ? wire::Interpolation::flat : wire::Interpolation::gouraud;
  Shading shading = ball.frame.view();
  shading.triangles = made.triangles.data();
  for (const raster::UnsortedEdgeBox& box : made.boxes) {
    std::vector<Fragment> fragments;
    for (std::uint32_t column = box.box.first; column < box.box.last(); ++column)
      fragments.push_back({box.box.triangle, static_cast<std::uint16_t>(column), 0});
    std::vector<float> light[3];
    for (auto& plane : light) plane.resize(fragments.size() + simd::kVectorSlack);
    float* planes[3] = {light[0].data(), light[1].data(), light[2].data()};
    shading_kernels(best()).shade_fragments(shading, fragments.data(), static_cast<std::uint32_t>(fragments.size()),
                                            box.line, planes);
    for (std::size_t k = 0; k < fragments.size(); ++k) {
      EXPECT_GE(light[0][k], low - 2e-3);
      EXPECT_LE(light[0][k], high + 2e-3);
      if (one_color) {
        EXPECT_NEAR(light[0][k], light[0][0], 1e-4);
      }
    }
  }
}

TEST(ColoredSurface, SamplesGetTheColors) {
  Ball whole, clipped(12, 0.3, kNear + 0.25);
  ASSERT_TRUE(!whole.dicer.reaches_outside() && clipped.dicer.reaches_outside());
  for (Ball* each : {&whole, &clipped}) {
    Ball& ball = *each;
    expect_within_colors(ball, ball.colored.by_vertices(ball.dicer, ball.coloring()), false);
    expect_within_colors(ball, ball.colored.by_triangles(ball.dicer, 0, ball.coloring()), true);
  }
}

}  // namespace
}  // namespace mars::shading
