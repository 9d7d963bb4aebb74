// Light that is summed up once it is known how much of it arrives: what is lit fully is lit as where nothing casts; the
// end of the sum is the same bits in plain code; a triangle's plane dims by the formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "node/shading/finish_light.h"
#include "node/shading/kernels.h"
#include "tests/node/shading/plain_light.h"
#include "tests/node/shape/patches.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shading {
namespace {

using shape::dot;
using shape::Random;
using shape::Vec3;

constexpr std::uint32_t kLine = 100;
const shape::Projection kView = shape::projection(640, 480, 2);

Vec3 unit_vector(const Vec3& a) {
  const double l = shape::length(a);
  return {a[0] / l, a[1] / l, a[2] / l};
}

// Triangles whose planes are before the eye about the line, with normals of their own.
struct UnsummedScenery {
  std::vector<geometry::Triangle> triangles;
  std::vector<Vec3> planes, normals;
  std::vector<wire::Material> materials;
  std::vector<geometry::EyeLight> lights;
  std::uint32_t casting = 0;
  wire::Fog fog;
  wire::ColorSpace space = wire::ColorSpace::coded;

  Shading shading() const {
    Shading shading{};
    shading.triangles = triangles.data();
    shading.materials = materials.data();
    shading.lights = lights.data();
    shading.light_count = static_cast<std::uint32_t>(lights.size());
    shading.casting_count = casting;
    shading.projection = kView;
    shading.pattern = shape::sample_pattern(16);
    shading.encoding.space = space;
    shading.ambient.sky = {0.5f, 0.6f, 0.7f};
    shading.up[1] = 1;
    shading.fog = fog;
    return shading;
  }
  // The plane n . p = -d; a triangle of `normal` everywhere.
  void add(const Vec3& n, double d, const Vec3& normal, std::uint32_t material) {
    geometry::Triangle t{};
    t.first_x = 320 * 256, t.first_y = static_cast<std::int32_t>(kLine * 256);
    const double scale = kView.scale;
    const Vec3 way{(320 - double{kView.center[0]}) / scale, (double{kView.center[1]} - kLine) / scale, -1};
    const double depth = dot(n, way) / -d, per_x = n[0] / scale / -d / 256, per_y = -n[1] / scale / -d / 256;
    const auto set = [&](shape::Value value, double times) {
      t.at_first[value] = static_cast<float>(depth * times);
      t.per_x[value] = static_cast<float>(per_x * times);
      t.per_y[value] = static_cast<float>(per_y * times);
    };
    set(shape::kDepth, 1);
    set(shape::kNormalX, normal[0]), set(shape::kNormalY, normal[1]), set(shape::kNormalZ, normal[2]);
    t.material = material;
    triangles.push_back(t);
    planes.push_back(n);
    normals.push_back(normal);
  }
};

Vec3 random_unit(Random& random, double least_z) {
  return unit_vector({random.real(-1, 1), random.real(-1, 1), random.real(least_z, 1)});
}

geometry::EyeLight random_eye_light(Random& random) {
  geometry::EyeLight light{};
  light.kind = static_cast<wire::LightKind>(random.whole(0, 2));
  const Vec3 to = random_unit(random, -0.2), axis = random_unit(random, 0.2);
  const double far = light.kind == wire::LightKind::directional ? 1 : 5;
  for (std::size_t k = 0; k < 3; ++k) {
    light.vector[k] = static_cast<float>(to[k] * far);
    light.axis[k] = static_cast<float>(-axis[k]);
    light.color[k] = static_cast<float>(random.real(0, 0.4));
  }
  light.cos_outer = 0.2f, light.cos_inner = 0.9f;
  light.reach = random.whole(0, 1) ? 6.0f : 0;
  return light;
}

// Normals `apart` from their planes.
UnsummedScenery random_unsummed_scenery(Random& random, double apart) {
  UnsummedScenery s;
  for (std::uint32_t k = 0; k < 5; ++k) {
    wire::Material material{{0.9f, 0.5f, 0.2f}, 0.3f, 0.7f, 0.4f, k == 4 ? 2.5f : 16.0f, 2};
    material.reflection = static_cast<wire::Reflection>(k % 4);
    material.roughness = 0.4f;
    s.materials.push_back(material);
  }
  for (int k = 0; k < 20; ++k) {
    const Vec3 n = random_unit(random, 0.5);
    Vec3 normal = n;
    for (double& a : normal) a += random.real(-apart, apart);
    s.add(n, random.real(2, 9), unit_vector(normal), static_cast<std::uint32_t>(random.whole(0, 4)));
  }
  for (int k = random.whole(1, 4); k > 0; --k) s.lights.push_back(random_eye_light(random));
  s.casting = static_cast<std::uint32_t>(random.whole(1, static_cast<int>(s.lights.size())));
  if (random.whole(0, 1)) s.fog = {{0.3f, 0.6f, 0.2f}, 1, 12};
  if (random.whole(0, 1)) s.space = wire::ColorSpace::linear;
  return s;
}

std::vector<Fragment> random_fragments(Random& random) {
  std::vector<Fragment> fragments(static_cast<std::size_t>(random.whole(1, 300)));
  for (Fragment& f : fragments)
    f = {static_cast<std::uint32_t>(random.whole(0, 19)), static_cast<std::uint16_t>(random.whole(220, 420)),
         static_cast<std::uint16_t>(random.whole(0, 15))};
  return fragments;
}

// Base, fog and terms of all fragments.
struct Unsummed {
  Unsummed(std::size_t count, std::uint32_t casting)
      : channels(4 + 3 * casting, std::vector<float>(count + simd::kVectorSlack)) {
    for (std::size_t k = 4; k < channels.size(); ++k) terms.push_back(channels[k].data());
    light = {{channels[0].data(), channels[1].data(), channels[2].data()}, channels[3].data(), terms.data()};
  }
  std::vector<std::vector<float>> channels;
  std::vector<float*> terms;
  UnsummedLight light{};
};

Unsummed unsummed_light_of(const UnsummedScenery& s, const std::vector<Fragment>& fragments, simd::InstructionSet set) {
  Unsummed out(fragments.size(), s.casting);
  shading_kernels(set).shade_unsummed(s.shading(), fragments.data(), static_cast<std::uint32_t>(fragments.size()),
                                      kLine, out.light);
  for (auto& channel : out.channels) std::fill(channel.end() - simd::kVectorSlack, channel.end(), 0.0f);
  return out;
}

using SummedLight = std::array<std::vector<float>, 3>;

template <typename Fill>
SummedLight light_of(std::size_t count, const Fill& fill) {
  SummedLight light;
  for (auto& channel : light) channel.resize(count + simd::kVectorSlack);
  float* const to[3] = {light[0].data(), light[1].data(), light[2].data()};
  fill(to);
  for (auto& channel : light) channel.resize(count);
  return light;
}

TEST(Unsummed, WhereAllLightArrivesIsLitAsWhereNothingCasts) {
  Random random(91);
  double worst = 0, brightest = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const UnsummedScenery s = random_unsummed_scenery(random, 0);
    const auto fragments = random_fragments(random);
    const auto count = static_cast<std::uint32_t>(fragments.size());
    const auto& kernels = shading_kernels(simd::best_instruction_set(""));
    const Unsummed unsummed = unsummed_light_of(s, fragments, simd::best_instruction_set(""));
    const std::vector<float> ones(count + simd::kVectorSlack, 1.0f);
    const std::vector<const float*> shares(s.casting, ones.data());
    const SummedLight summed = light_of(
        count, [&](float* const* to) { kernels.sum_up(s.shading(), unsummed.light, shares.data(), count, to); });
    const SummedLight whole = light_of(
        count, [&](float* const* to) { kernels.shade_fragments(s.shading(), fragments.data(), count, kLine, to); });
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < count; ++k) {
        const double most = s.space == wire::ColorSpace::coded ? 1 : 1e9;
        const double one = std::min(most, double{summed[c][k]}), other = std::min(most, double{whole[c][k]});
        worst = std::max(worst, std::abs(one - other));
        brightest = std::max(brightest, other);
      }
  }
  EXPECT_LT(worst, 2e-5);
  EXPECT_GT(brightest, 0.5);
}

TEST(Unsummed, HasTheSameBitsEverywhere) {
  Random random(92);
  for (int trial = 0; trial < 30; ++trial) {
    const UnsummedScenery s = random_unsummed_scenery(random, 0.6);
    const auto fragments = random_fragments(random);
    const Unsummed narrow = unsummed_light_of(s, fragments, simd::best_instruction_set("sse2"));
    for (const simd::InstructionSet set : simd::all_sets())
      EXPECT_EQ(unsummed_light_of(s, fragments, set).channels, narrow.channels)
          << simd::name_of(set) << ", trial " << trial;
  }
}

// As ShadowPainter sums up single pixels.
TEST(Unsummed, TheEndOfTheSumIsThePlainTwins) {
  Random random(93);
  std::size_t dark = 0, limited = 0;
  for (int trial = 0; trial < 200; ++trial) {
    UnsummedScenery s = random_unsummed_scenery(random, 0);
    const auto count = static_cast<std::uint32_t>(random.whole(1, 70));
    Unsummed in(count, s.casting);
    for (auto& channel : in.channels)
      for (float& number : channel) number = random.whole(0, 4) ? static_cast<float>(random.real(-0.1, 0.9)) : 0;
    for (float& share : in.channels[3]) share = std::clamp(share, 0.0f, 1.0f);
    if (trial % 5 == 0) in.channels[0][0] = std::nanf("");
    if (trial % 7 == 0) in.channels[1][0] = 3e35f;
    std::vector<std::vector<float>> shares(s.casting, std::vector<float>(count + simd::kVectorSlack));
    std::vector<const float*> rows;
    for (auto& row : shares) {
      for (float& share : row) share = static_cast<float>(random.whole(0, 16)) / 16;
      rows.push_back(row.data());
    }
    for (const simd::InstructionSet set : simd::all_sets()) {
      const SummedLight light = light_of(
          count, [&](float* const* to) { shading_kernels(set).sum_up(s.shading(), in.light, rows.data(), count, to); });
      for (std::uint32_t k = 0; k < count; ++k) {
        float plain[3];
        for (std::size_t c = 0; c < 3; ++c) {
          plain[c] = in.light.base[c][k];
          for (std::size_t l = 0; l < s.casting; ++l) plain[c] += in.light.terms[3 * l + c][k] * shares[l][k];
        }
        finish_light(s.shading(), in.light.fog[k], plain);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(light[c][k], plain[c]) << simd::name_of(set) << ", trial " << trial << ", " << k;
          dark += plain[c] == 0, limited += plain[c] >= 1;
        }
      }
    }
  }
  EXPECT_GT(dark, 100u);
  EXPECT_GT(limited, 100u);
}

// M. J.-Y. Chiang et al., "Taming the shadow terminator", 2019, as the kernel's comment has it.
double terminator(const Vec3& plane, const Vec3& normal, const Vec3& to_light) {
  const double g = dot(plane, to_light), s = dot(normal, to_light), d = dot(plane, normal);
  if (d <= 0.25) return 1;
  const double x = std::clamp(g / (s * d), 0.0, 1.0);
  return x + x * x - x * x * x;
}

// Of one directional light that casts: the share of what it would add if it did not.
TEST(Unsummed, PlanesThatTurnAwayDimByTheFormula) {
  Random random(94);
  int dim = 0, dark = 0, full = 0;
  for (int trial = 0; trial < 300; ++trial) {
    UnsummedScenery s = random_unsummed_scenery(random, 0.7);
    s.fog = {};
    s.lights.resize(1);
    s.lights[0].kind = wire::LightKind::directional;
    const Vec3 to_light = random_unit(random, -0.9);
    for (std::size_t k = 0; k < 3; ++k)
      s.lights[0].vector[k] = static_cast<float>(to_light[k]), s.lights[0].color[k] = 1;
    s.casting = 1;
    s.space = wire::ColorSpace::linear;
    const auto fragments = random_fragments(random);
    const Unsummed unsummed = unsummed_light_of(s, fragments, simd::best_instruction_set(""));
    for (std::size_t k = 0; k < fragments.size(); ++k) {
      const Fragment& f = fragments[k];
      const geometry::Triangle& t = s.triangles[f.triangle];
      const shape::SamplePattern& pattern = shape::sample_pattern(16);
      const double x = 256.0 * f.column + pattern.x[f.sample], y = 256.0 * kLine + pattern.y[f.sample];
      const double w = 1 / (t.at_first[shape::kDepth] + (y - t.first_y) * double{t.per_y[shape::kDepth]} +
                            (x - t.first_x) * double{t.per_x[shape::kDepth]});
      const Vec3 place{(x / 256 - double{kView.center[0]}) / double{kView.scale} * w,
                       (double{kView.center[1]} - y / 256) / double{kView.scale} * w, -w};
      Shading lit = s.shading();
      lit.ambient = {{0, 0, 0}, {0, 0, 0}};
      // The normal turns to the eye, and the plane with it.
      Vec3 normal = s.normals[f.triangle], plane = s.planes[f.triangle];
      if (s.materials[t.material].sides == 2 && dot(normal, place) > 0) continue;
      const Vec3 all = plain_light(lit, s.materials[t.material], {place, normal});
      const double share = terminator(plane, normal, to_light);
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(unsummed.light.terms[c][k], all[c] * share, 2e-3 + 2e-3 * all[c]) << trial << ", share " << share;
      if (all[0] > 0.05) {
        dark += share == 0, full += share == 1, dim += share > 0 && share < 0.99;
      }
    }
  }
  EXPECT_GT(dim, 200);
  EXPECT_GT(dark, 20);
  EXPECT_GT(full, 200);
}

}  // namespace
}  // namespace mars::shading
