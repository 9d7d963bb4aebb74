// Reflection models, lights and light from all around against what physics and their formulas say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "node/shading/environment.h"
#include "tests/node/shading/vertex_light.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shading {

using shape::dot;
using shape::Vec3;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr wire::Reflection kModels[] = {wire::Reflection::phong, wire::Reflection::blinn_phong,
                                        wire::Reflection::cook_torrance, wire::Reflection::metallic_roughness};
constexpr wire::Reflection kPhysical[] = {wire::Reflection::cook_torrance, wire::Reflection::metallic_roughness};

simd::InstructionSet best_set() { return simd::best_instruction_set(""); }

Vec3 scaled(double factor, const Vec3& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
Vec3 unit_direction(const Vec3& a) { return scaled(1 / shape::length(a), a); }
Vec3 direction(double cosine, double turn) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

geometry::EyeLight directional(const Vec3& to) {
  geometry::EyeLight light{};
  light.kind = wire::LightKind::directional;
  for (std::size_t k = 0; k < 3; ++k) {
    light.vector[k] = static_cast<float>(to[k]);
    light.color[k] = 1;
  }
  return light;
}

geometry::EyeLight at_place(wire::LightKind kind, const Vec3& place) {
  geometry::EyeLight light = directional(place);
  light.kind = kind;
  return light;
}

// Seen along the view axis from 5 away, lit from all directions in turn: what it sends to the eye is
// pi x reflectance x N.L of the angles.
class Probe {
 public:
  // A direction to the light from a surface whose normal is z and which is seen from `view`.
  void add(const Vec3& light, const Vec3& view) {
    // Turned so that the light is along a fixed direction and the rest as before.
    const Vec3 w = light,
               u = unit_direction(std::abs(w[2]) < 0.9 ? shape::cross({0, 0, 1}, w) : shape::cross({1, 0, 0}, w)),
               v = shape::cross(w, u);
    const auto turned = [&](const Vec3& a) { return Vec3{dot(a, u), dot(a, v), dot(a, w)}; };
    spots_.push_back({scaled(-5, turned(view)), turned({0, 0, 1})});
  }
  Colors reflect(const wire::Material& material) {
    Frame frame;
    frame.material = material;
    frame.shading.ambient = {{}, {}};
    frame.lights = {directional({0, 0, 1})};
    return light_of(frame, spots_, best_set());
  }

 private:
  std::vector<Spot> spots_;
};

// What is reflected to the view of light that comes evenly from all around: pi / pi x the integral over directions.
// They are the closer together the nearer they are to the mirrored view, round which highlights lie: 1 less their
// cosine is twice the fourth power of what is taken evenly.
Vec3 albedo(const wire::Material& material, double view_cosine) {
  constexpr int kSteps = 200, kTurns = 160;
  const Vec3 view = direction(view_cosine, 0), mirrored = direction(view_cosine, kPi), v = {0, 1, 0};
  const Vec3 u = shape::cross(v, mirrored);
  Probe probe;
  std::vector<double> shares;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kTurns; ++j) {
      const double step = (i + 0.5) / kSteps, turn = (j + 0.5) / kTurns * 2 * kPi;
      const Vec3 off = direction(1 - 2 * std::pow(step, 4), turn);
      Vec3 light;
      for (std::size_t k = 0; k < 3; ++k) light[k] = off[0] * u[k] + off[1] * v[k] + off[2] * mirrored[k];
      if (light[2] <= 0) continue;
      probe.add(light, view);
      shares.push_back(8 * std::pow(step, 3) * 2 / (kSteps * kTurns));
    }
  const Colors colors = probe.reflect(material);
  Vec3 sum{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < shares.size(); ++k) sum[c] += shares[k] * colors[c][k];
  return sum;
}

wire::Material material(wire::Reflection reflection, float roughness, float metallic = 0) {
  wire::Material m{{1, 1, 1}, 0, 1, 1, 32, 2};
  m.reflection = reflection;
  m.roughness = roughness;
  m.metallic = metallic;
  return m;
}

TEST(Reflection, NeverMoreThanArrives) {
  for (const double view : {0.05, 0.1, 0.3, 0.7, 1.0})
    for (const float rough : {0.1f, 0.25f, 0.5f, 1.0f}) {
      wire::Material facets = material(wire::Reflection::cook_torrance, rough);
      facets.diffuse = 0;
      for (const float index : {1.5f, 100.0f}) {  // 100: nearly all is reflected
        facets.refraction = index;
        EXPECT_LE(albedo(facets, view)[0], 1.01) << view << ' ' << rough << ' ' << index;
      }
      const wire::Material metal = material(wire::Reflection::metallic_roughness, rough, 1);
      EXPECT_LE(albedo(metal, view)[0], 1.01) << view << ' ' << rough;
      // glTF's formula for what is not metal exceeds this where it is bright and smooth and seen from the side.
      wire::Material paint = material(wire::Reflection::metallic_roughness, rough);
      EXPECT_LE(albedo(paint, view)[0], 1.7) << view << ' ' << rough;
      paint.color = {0.8f, 0.8f, 0.8f};
      if (rough >= 0.5f || view >= 0.3) {
        EXPECT_LE(albedo(paint, view)[0], 1.01) << view << ' ' << rough;
      }
    }
}

// Smooth metal loses nothing that its facets do not hide.
TEST(Reflection, SmoothMetalReflectsNearlyAll) {
  EXPECT_GT(albedo(material(wire::Reflection::metallic_roughness, 0.3f, 1), 0.7)[0], 0.97);
  wire::Material mirror = material(wire::Reflection::cook_torrance, 0.2f);
  mirror.diffuse = 0, mirror.refraction = 100;
  EXPECT_GT(albedo(mirror, 0.7)[0], 0.93);
}

TEST(Reflection, WhiteDiffuseSurfaceIsAsBrightAsItsLight) {
  for (const wire::Reflection model : kModels) {
    Probe probe;
    wire::Material m = material(model, 1);
    m.specular = 0;
    probe.add({0, 0, 1}, direction(0.8, 0));
    const double light = probe.reflect(m)[0][0];
    EXPECT_NEAR(light, 1, model == wire::Reflection::metallic_roughness ? 0.05 : 1e-6);
  }
}

// Light that goes the way back is reflected alike: the result divided by N.L does not change.
TEST(Reflection, IsReciprocal) {
  shape::Random random(70);
  for (const wire::Reflection model : kPhysical)
    for (int trial = 0; trial < 20; ++trial) {
      Probe probe;
      const Vec3 a = direction(random.real(0.1, 1), random.real(0, 7)),
                 b = direction(random.real(0.1, 1), random.real(0, 7));
      probe.add(a, b);
      probe.add(b, a);
      const Colors there = probe.reflect(
          material(model, static_cast<float>(random.real(0.1, 1)), static_cast<float>(random.real(0, 1))));
      const double one = there[0][0] / a[2], other = there[0][1] / b[2];
      EXPECT_NEAR(one, other, 2e-4 * one);
    }
}

// The smaller the highlight, the more of its brightness hangs on N.H's last bits.
TEST(Reflection, IsTheFormulaToAFloat) {
  shape::Random random(71);
  for (const wire::Reflection model : kModels)
    for (const auto& [rough, tolerance] : {std::pair(0.0f, 4e-2), {0.1f, 1.5e-2}, {0.3f, 3e-4}, {1.0f, 3e-5}}) {
      Probe probe;
      std::vector<std::pair<Vec3, Vec3>> pairs;
      for (int k = 0; k < 300; ++k) {
        const double cosine = random.real(0.1, 1), turn = random.real(0, 7);
        const double off = random.real(0, 0.1);  // from the mirrored direction
        pairs.emplace_back(direction(cosine, turn), direction(std::min(1.0, cosine + off / 3), turn + kPi + off));
        probe.add(pairs.back().first, pairs.back().second);
      }
      wire::Material m = material(model, rough, 0.5f);
      m.color = {0.9f, 0.5f, 0.1f};
      const Colors colors = probe.reflect(m);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const Vec3 right = plain_reflection(m, {0, 0, 1}, pairs[k].first, pairs[k].second);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(colors[c][k], right[c], tolerance * right[c] + 1e-6) << static_cast<int>(model) << ' ' << rough;
      }
    }
}

// A sphere of radius 2 round (0, 0, -10), lit from the eye's right.
TEST(Reflection, OnASphere) {
  shape::Random random(72);
  for (const wire::Reflection model : kModels) {
    Frame frame;
    frame.material = material(model, 0.4f, 0.3f);
    frame.lights = {directional(unit_direction({1, 0.5, 0.7}))};
    frame.shading.ambient = {{0.1f, 0.1f, 0.3f}, {0.2f, 0.1f, 0}};
    frame.material.ambient = 0.5f;
    std::vector<Spot> spots;
    for (int k = 0; k < 500; ++k) {
      const Vec3 normal = direction(random.real(0.25, 1), random.real(0, 2 * kPi));
      spots.push_back({{2 * normal[0], 2 * normal[1], 2 * normal[2] - 10}, normal});
    }
    const Colors colors = light_of(frame, spots, best_set());
    for (std::size_t k = 0; k < spots.size(); ++k) {
      const Vec3 right = plain_light(frame.view(), frame.material, spots[k]);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(colors[c][k], right[c], 2e-4 * right[c] + 2e-6);
    }
  }
}

TEST(Lights, ConeAndReach) {
  Frame frame;
  frame.material = {{1, 1, 1}, 0, 1, 0, 1, 2};
  frame.lights = {at_place(wire::LightKind::spot, {0, 0, 0})};
  geometry::EyeLight& spot = frame.lights[0];
  spot.axis[2] = -1;
  spot.cos_inner = 0.9f, spot.cos_outer = 0.7f;
  spot.reach = 4;
  const auto bright = [&](double cosine, double distance) {
    const Vec3 place = scaled(distance, {std::sqrt(1 - cosine * cosine), 0, -cosine});
    return light_of(frame, {{place, scaled(-1 / distance, place)}}, best_set())[0][0];
  };
  EXPECT_NEAR(bright(1, 4), 0.5, 1e-6) << "half at its reach";
  EXPECT_NEAR(bright(0.91, 8), 0.2, 1e-6) << "fully within the inner cone";
  EXPECT_NEAR(bright(0.8, 4), 0.25, 1e-5) << "half between the cones";
  EXPECT_EQ(bright(0.69, 1), 0) << "nothing outside";
  spot.cos_inner = spot.cos_outer = 0.8f;
  EXPECT_NEAR(bright(0.801, 4), 0.5, 1e-6) << "a sharp cone";
  EXPECT_EQ(bright(0.799, 4), 0);
}

// The split sum's table against light summed up from all directions. Seen from the side it is less exact.
TEST(Environment, TableIsTheIntegral) {
  const EnvironmentTable& table = environment_table();
  constexpr int kSide = EnvironmentTable::kSide;
  for (const int row : {2, 4, 6, 8, 11, 15})
    for (const int column : {0, 2, 7, 11, 15}) {
      const auto at = static_cast<std::size_t>(row * kSide + column);
      const double view = column == 0 ? 1.0 / 64 : column / (kSide - 1.0), tolerance = column == 0 ? 0.045 : 0.015;
      wire::Material metal = material(wire::Reflection::metallic_roughness, static_cast<float>(row) / (kSide - 1), 1);
      EXPECT_NEAR(table.colored[at] + table.white[at], albedo(metal, view)[0], tolerance) << row << ' ' << column;
      metal.color = {0, 0, 0};
      EXPECT_NEAR(table.white[at], albedo(metal, view)[0], tolerance) << row << ' ' << column;
    }
  for (int k = 0; k < kSide * kSide; ++k) EXPECT_LE(table.colored[k] + table.white[k], 1.01f) << k;
}

// In light that is white all around a white surface is as bright, and metal as it reflects lights from all around.
TEST(Environment, LightsSurfaces) {
  Frame frame;
  for (const float rough : {0.2f, 0.4f, 1.0f})
    for (const double cosine : {0.05, 0.5, 1.0}) {
      const auto light = [&](float metallic) {
        frame.material = material(wire::Reflection::metallic_roughness, rough, metallic);
        frame.material.ambient = 1;
        return light_of(frame, {{{0, 0, -3}, direction(cosine, 1)}}, best_set())[0][0];
      };
      EXPECT_NEAR(light(0), 1, 1e-5);
      const float of_metal = light(1);
      EXPECT_NEAR(of_metal, albedo(frame.material, cosine)[0], 0.03) << rough << ' ' << cosine;
    }
}

TEST(Environment, SkyAndGround) {
  Frame frame;
  frame.shading.ambient = {{1, 0.5f, 0}, {0, 0.5f, 1}};
  for (const wire::Reflection model : kModels) {
    frame.material = material(model, 0, 1);
    frame.material.ambient = 1;
    // The eye sees 45 degrees up in a mirror that leans back by as much, and down in one that leans forward.
    const Colors colors = light_of(
        frame,
        {{{0, 0, -3}, unit_direction({0, 1, 1})}, {{0, 0, -3}, unit_direction({0, -1, 1})}, {{0, 0, -3}, {0, 0, 1}}},
        best_set());
    EXPECT_GT(colors[0][0], colors[2][0]);
    EXPECT_LT(colors[0][1], colors[2][1]);
    EXPECT_NEAR(colors[0][2], colors[2][2], 1e-6);
    EXPECT_NEAR(colors[1][0], colors[1][1], 1e-6);
  }
}

// Whatever a film may say, light is a number; and the same one everywhere.
TEST(Extremes, LightIsAlwaysANumber) {
  shape::Random random(73);
  constexpr double kSizes[] = {0, 1e-30, 1e-9, 1e-3, 1, 1e3, 1e12, 1e24};
  const auto extreme = [&] { return kSizes[random.whole(0, 7)] * random.real(-1, 1); };
  for (int trial = 0; trial < 400; ++trial) {
    Frame frame;
    frame.material = {{1, 0, 0.5f}, 10, 10, 10, random.whole(0, 1) ? 0.0f : 65535.0f, 2};
    frame.material.reflection = kModels[random.whole(0, 3)];
    frame.material.roughness = static_cast<float>(random.whole(0, 1));
    frame.material.metallic = static_cast<float>(random.whole(0, 1));
    frame.material.refraction = random.whole(0, 1) ? 100.0f : std::nextafter(1.0f, 2.0f);
    if (random.whole(0, 1)) frame.shading.ambient = {{wire::kMostLight, 0, 1}, {0, wire::kMostLight, 1}};
    for (float& up : frame.shading.up) up = static_cast<float>(extreme());
    for (int k = 0; k < 64; ++k) {
      geometry::EyeLight light = at_place(static_cast<wire::LightKind>(random.whole(0, 2)), {});
      for (std::size_t c = 0; c < 3; ++c) {
        light.vector[c] = static_cast<float>(extreme());
        light.axis[c] = static_cast<float>(extreme());
        light.color[c] = wire::kMostLight;
      }
      light.cos_outer = light.cos_inner = static_cast<float>(random.real(-1, 1));
      light.reach = static_cast<float>(std::min(std::abs(extreme()), 1e12));
      frame.lights.push_back(light);
    }
    std::vector<Spot> spots;
    for (int k = 0; k < 20; ++k) {
      const geometry::EyeLight& near = frame.lights[static_cast<std::size_t>(k)];
      const bool at_light = random.whole(0, 3) == 0;
      const Vec3 place =
          at_light ? Vec3{near.vector[0], near.vector[1], near.vector[2]} : Vec3{extreme(), extreme(), extreme()};
      spots.push_back({{place[0], place[1], place[2] == 0 ? -1e-9 : place[2]},
                       random.whole(0, 4) ? direction(random.real(-1, 1), random.real(0, 7)) : Vec3{}});
    }
    const Colors colors = light_of(frame, spots, best_set());
    for (const auto& plane : colors)
      for (const float color : plane) EXPECT_TRUE(color >= 0 && color <= 1e30f) << color << ", trial " << trial;
    for (const simd::InstructionSet set : simd::all_sets())
      EXPECT_EQ(light_of(frame, spots, set), colors) << simd::name_of(set) << ", trial " << trial;
  }
}

// What films really have at their limits is lit as the formulas say, not cut off as a number too large.
TEST(Extremes, SixtyFourLightsAtTheirMost) {
  Frame frame;
  for (int k = 0; k < 64; ++k) {
    frame.lights.push_back(directional({0, 0, 1}));
    for (float& color : frame.lights.back().color) color = wire::kMostLight;
  }
  for (const wire::Reflection model : kModels) {
    frame.material = material(model, 0, 1);
    const double right = plain_light(frame.view(), frame.material, {{0, 0, -3}, {0, 0, 1}})[0];
    EXPECT_NEAR(light_of(frame, {{{0, 0, -3}, {0, 0, 1}}}, best_set())[0][0], right, 4e-2 * right);
  }
}

}  // namespace
}  // namespace mars::shading
