// What nodes draw against the plain twin (reference.h), sample for sample, and against formulas.
#include "tests/render/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kReferenceBackground = 0xff00ff;

TEST(Reference, Crowd) {
  const auto film = crowd(320, 180, 5, 5);
  for (const std::uint32_t frame : {0u, 4u}) expect_as_reference(film, frame, 3);
}

TEST(Reference, CrowdWithSamples) {
  for (const std::uint32_t samples : {2u, 4u, 8u, 16u})
    for (const std::uint32_t frame : {0u, 2u})
      expect_as_reference(with_samples(crowd(160, 90, 3, 3), samples), frame, 3);
}

TEST(Reference, AllModelsLightsAndInterpolations) {
  for (const std::uint32_t samples : {1u, 4u, 16u})
    for (const std::uint32_t frame : {0u, 2u})
      expect_as_reference(richly_lit(with_samples(crowd(160, 90, 3, 3), samples)), frame, 2);
}

TEST(Reference, FlightThroughTheNearPlane) {
  expect_as_reference(flight(200, 112, 4), 3, 2);
  expect_as_reference(with_samples(flight(100, 56, 4), 4), 3, 2);
  expect_as_reference(richly_lit(with_samples(flight(100, 56, 4), 2)), 3, 2);
}

// Of coinciding faces what stands still wins, then the lower polygon number.
TEST(Reference, Ties) {
  const auto film = ties(160, 120);
  for (const std::uint32_t frame : {0u, 1u, 2u}) expect_as_reference(film, frame, 3);
}

// A single body in the middle of the picture, seen along y, on a background no material shows.
wire::FilmData body(const std::vector<wire::Patch>& patches, std::uint32_t size, std::uint32_t dice, double turn) {
  FilmMaker maker(size, size, 1);
  maker.add_segment(maker.add_shape(patches), maker.add_material({{0.5f, 0.7f, 0.9f}, 0.1f, 0.65f, 0.45f, 20, 2}),
                    {placed({-std::cos(turn) + std::sin(turn), -std::sin(turn) - std::cos(turn), -1}, 2, turn)});
  maker.add_light({wire::LightKind::directional, {-0.48f, -0.6f, 0.64f}, {1, 1, 1}});
  maker.set_cameras({looking({0, -8, 0}, {0, 0, 0}, 30)});
  wire::FilmData film = maker.make();
  film.settings.dice = dice;
  return film;
}

Pixels draw_body(const wire::FilmData& film) { return run_film(FilmBlock(film).bytes()).frames.at(0); }

// The unit sphere in the middle: the ray through a sample meets it where |eye + t d| = 1.
struct SphereHit {
  bool hit;
  double distance_from_edge;  // pixels inside the outline (outside: negative), about
  double normal[3];
  double eye[3];
};
SphereHit meet_sphere(std::uint32_t column, std::uint32_t row, std::uint32_t size) {
  const double scale = size / 2.0 / std::tan(15 * 3.14159265358979 / 180);
  const double d[3] = {(column + 0.5 - size / 2.0) / scale, 1, -(row + 0.5 - size / 2.0) / scale};
  const double length2 = d[0] * d[0] + 1 + d[2] * d[2];
  const double along = 8 / length2, offset2 = 64 - along * along * length2;
  SphereHit out{offset2 < 1, (1 - std::sqrt(offset2)) * scale / 8, {}, {}};
  if (!out.hit) return out;
  const double t = along - std::sqrt((1 - offset2) / length2);
  const double place[3] = {t * d[0], t * d[1] - 8, t * d[2]};
  for (int axis = 0; axis < 3; ++axis) {
    out.normal[axis] = place[axis];
    out.eye[axis] = -d[axis] / std::sqrt(length2);
  }
  return out;
}

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

TEST(Sphere, OutlineAndShadingFollowTheFormula) {
  constexpr std::uint32_t kSize = 400;
  const Pixels pixels = draw_body(body(modeler::make_sphere(), kSize, 0, 0.3));
  const double light[3] = {-0.48, -0.6, 0.64};
  double worst = 0, sum = 0;
  int counted = 0;
  for (std::uint32_t row = 0; row < kSize; ++row)
    for (std::uint32_t column = 0; column < kSize; ++column) {
      const std::uint32_t pixel = pixels[row * kSize + column];
      const SphereHit hit = meet_sphere(column, row, kSize);
      const bool sure = std::abs(hit.distance_from_edge) > 0.3;
      EXPECT_TRUE(!sure || (pixel != kReferenceBackground) == hit.hit) << column << ", " << row;
      if (!hit.hit || hit.distance_from_edge < 1) continue;
      const double facing = std::max(0.0, dot(hit.normal, light));
      const double mirrored = facing > 0 ? 2 * facing * dot(hit.normal, hit.eye) - dot(light, hit.eye) : 0;
      const double highlight = std::pow(std::max(0.0, mirrored), 20);
      const double expected = 255 * std::min(1.0, 0.1 * 0.7 + 0.65 * 0.7 * facing + 0.45 * highlight);
      const double error = std::abs(expected - static_cast<double>(pixel >> 8 & 255));
      worst = std::max(worst, error);
      sum += error;
      ++counted;
    }
  EXPECT_GT(counted, 25000);
  EXPECT_LT(sum / counted, 0.5);
  EXPECT_LT(worst, 4) << "levels of 255";
}

// A closed body shows its background nowhere inside its outline: what is background is connected to the border.
int holes(const Pixels& pixels, std::uint32_t size) {
  std::vector<std::uint8_t> outside(pixels.size());
  std::vector<std::size_t> open;
  const auto visit = [&](std::size_t i) {
    if (pixels[i] != kReferenceBackground || outside[i]) return;
    outside[i] = 1;
    open.push_back(i);
  };
  for (std::size_t i = 0; i < size; ++i)
    for (const std::size_t border : {i, (size - 1) * size + i, i * size, i * size + size - 1}) visit(border);
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    if (i % size > 0) visit(i - 1);
    if (i % size + 1 < size) visit(i + 1);
    if (i >= size) visit(i - size);
    if (i + size < pixels.size()) visit(i + size);
  }
  int count = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) count += pixels[i] == kReferenceBackground && !outside[i];
  return count;
}

TEST(Closed, NoBackgroundInsideTheOutlineAtAnyDicing) {
  const std::vector<wire::Patch> bodies[] = {modeler::make_sphere(), modeler::make_cylinder(), modeler::make_cone(0),
                                             modeler::make_cone(0.5), modeler::make_box()};
  for (const auto& patches : bodies)
    for (const std::uint32_t dice : {0u, 1u, 2u, 3u, 5u, 8u, 13u, 64u})
      for (const double turn : {0.0, 0.4, 1.9})
        EXPECT_EQ(holes(draw_body(body(patches, 200, dice, turn)), 200), 0) << "dice " << dice << ", turn " << turn;
}

// Rates differ from patch to patch where a body is seen from near: stitches must hold there too.
TEST(Closed, NoHolesSeenFromNearWithManyRates) {
  for (const double near : {1.02, 1.2, 2.0}) {
    wire::FilmData film = body(modeler::make_sphere(), 300, 0, 0.2);
    film.cameras = {looking({0.3, -near, 0.2}, {0, 0, 0.1}, 80, 0.001)};
    EXPECT_EQ(holes(draw_body(film), 300), 0) << near;
  }
}

// From all sides a lit convex body is nowhere darker than its ambient light says on the side of the light:
// no triangle's normal is turned the wrong way.
TEST(Closed, NoTriangleIsLitFromBehind) {
  const std::vector<wire::Patch> bodies[] = {modeler::make_sphere(), modeler::make_cone(0), modeler::make_cylinder()};
  for (const auto& patches : bodies)
    for (int i = 0; i < 24; ++i) {
      wire::FilmData film = body(patches, 240, 0, 0.1 * i);
      const double angle = 0.26 * i;
      film.cameras = {looking({4 * std::sin(angle), -4 * std::cos(angle), 2.5}, {0, 0, 0}, 40)};
      // A light at the eye lights every normal that is turned to the eye.
      film.lights = {{wire::LightKind::point,
                      {static_cast<float>(4 * std::sin(angle)), static_cast<float>(-4 * std::cos(angle)), 2.5f},
                      {1, 1, 1}}};
      const Pixels pixels = draw_body(film);
      int dark = 0;
      for (std::size_t k = 240; k + 240 < pixels.size(); ++k) {
        const bool inside = pixels[k - 1] != kReferenceBackground && pixels[k + 1] != kReferenceBackground &&
                            pixels[k - 240] != kReferenceBackground && pixels[k + 240] != kReferenceBackground &&
                            pixels[k] != kReferenceBackground;
        const auto level = [&](std::size_t at) { return static_cast<int>(pixels[at] >> 8 & 255); };
        dark += inside && level(k) < level(k - 1) / 2 && level(k) < level(k + 1) / 2;
      }
      EXPECT_EQ(dark, 0) << "view " << i;
    }
}

}  // namespace
}  // namespace mars::test
