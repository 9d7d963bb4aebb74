// The shading kernels: the plain twin's light sample by sample, runs and pixels in order, and the same bits from every
// instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "node/shading/kernels.h"
#include "tests/node/shading/plain_light.h"
#include "tests/node/shape/patches.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shading {

using shape::operator-;

namespace {

using geometry::Triangle;

constexpr std::uint32_t kGap = kNoTriangle;

// One line of a picture with all that shading it needs.
struct Scenery {
  std::vector<Triangle> triangles;
  std::vector<wire::Material> materials;
  std::vector<geometry::EyeLight> lights;
  std::vector<std::uint32_t> ids;  // one a column
  std::uint32_t line = 100;
  shape::Projection view = shape::projection(640, 480, 2);
  wire::AmbientLight ambient;
  wire::Fog fog;

  Shading shading() const {
    Shading shading{};
    shading.triangles = triangles.data();
    shading.materials = materials.data();
    shading.lights = lights.data();
    shading.light_count = static_cast<std::uint32_t>(lights.size());
    shading.projection = view;
    shading.pattern = shape::sample_pattern(16);
    shading.ambient = ambient;
    shading.up[1] = 0.8f, shading.up[2] = 0.6f;
    shading.fog = fog;
    return shading;
  }
};

struct Result {
  std::vector<wire::Run> runs;
  std::vector<std::uint32_t> pixels;
};

// Behind the line and behind the pixels there is the slack that kernels may use, and no more.
Result shade(const Scenery& scenery, simd::InstructionSet set, Extent extent) {
  constexpr std::uint32_t kUntouched = 0xabcdef01;
  std::vector<std::uint32_t> ids = scenery.ids;
  ids.resize(ids.size() + simd::kVectorSlack, 0);
  const auto shown = static_cast<std::size_t>(
      extent.first < extent.last
          ? std::count_if(ids.begin() + extent.first, ids.begin() + extent.last, [](auto id) { return id != kGap; })
          : 0);
  Result result{std::vector<wire::Run>(ids.size()),
                std::vector<std::uint32_t>(shown + simd::kVectorSlack + 1, kUntouched)};
  const Shaded done = shading_kernels(set).shade(scenery.shading(), ids.data(), scenery.line, extent,
                                                 result.runs.data(), result.pixels.data());
  EXPECT_EQ(done.pixels, shown);
  EXPECT_EQ(result.pixels.back(), kUntouched);
  result.runs.resize(done.runs);
  result.pixels.resize(done.pixels);
  return result;
}

Result shade_all(const Scenery& scenery, const char* limit = "") {
  return shade(scenery, simd::best_instruction_set(limit), {0, static_cast<std::uint32_t>(scenery.ids.size())});
}

void set_plane(Triangle& t, shape::Value value, float at_first, float per_x, float per_y) {
  t.at_first[value] = at_first;
  t.per_x[value] = per_x;
  t.per_y[value] = per_y;
}

// A triangle's planes about depth 1 / w, normals that vary along the line.
Triangle random_triangle(shape::Random& random, std::size_t materials) {
  Triangle t{};
  t.first_x = random.whole(0, 640 * 256);
  t.first_y = random.whole(80 * 256, 120 * 256);
  set_plane(t, shape::kDepth, static_cast<float>(random.real(0.1, 1)), static_cast<float>(random.real(-2e-7, 2e-7)),
            1e-7f);
  for (const shape::Value value : {shape::kNormalX, shape::kNormalY, shape::kNormalZ})
    set_plane(t, value, static_cast<float>(random.real(-1, 1)), static_cast<float>(random.real(-4e-6, 4e-6)),
              static_cast<float>(random.real(-4e-6, 4e-6)));
  if (random.whole(0, 9) == 0)
    for (const shape::Value value : {shape::kNormalX, shape::kNormalY, shape::kNormalZ}) set_plane(t, value, 0, 0, 0);
  t.material = static_cast<std::uint32_t>(random.whole(0, static_cast<std::int32_t>(materials) - 1));
  return t;
}

geometry::EyeLight random_light(shape::Random& random) {
  geometry::EyeLight light{};
  light.kind = static_cast<wire::LightKind>(random.whole(0, 2));
  const shape::Vec3 to{random.real(-1, 1), random.real(-1, 1), random.real(-0.3, 1)};
  const double scale = light.kind != wire::LightKind::directional ? 5 : 1 / shape::length(to);
  const shape::Vec3 axis{random.real(-1, 1), random.real(-1, 1), random.real(-1, -0.1)};
  for (std::size_t k = 0; k < 3; ++k) {
    light.vector[k] = static_cast<float>(to[k] * scale);
    light.color[k] = static_cast<float>(random.real(0, 0.8));
    light.axis[k] = static_cast<float>(axis[k] / shape::length(axis));
  }
  light.cos_outer = static_cast<float>(random.real(-0.5, 0.9));
  light.cos_inner = static_cast<float>(random.real(light.cos_outer + 0.05, 1));
  light.reach = random.whole(0, 1) == 1 ? static_cast<float>(random.real(1, 20)) : 0;
  return light;
}

wire::AmbientLight random_ambient(shape::Random& random) {
  wire::AmbientLight ambient;
  for (std::size_t c = 0; c < 3; ++c) {
    ambient.sky[c] = static_cast<float>(random.real(0, 2));
    ambient.ground[c] = static_cast<float>(random.real(0, 1));
  }
  return ambient;
}

// Of any model, but of highlights that are not so small that a float's error shows.
wire::Material random_material(shape::Random& random, float exponent) {
  const auto part = [&] { return static_cast<float>(random.real(0, 1)); };
  wire::Material material{{part(), part(), part()}, 0.2f * part(), part(), part(), exponent, 2};
  material.reflection = static_cast<wire::Reflection>(random.whole(0, 3));
  if (random.whole(0, 7) == 0) material.interpolation = wire::Interpolation::gouraud;
  material.roughness = 0.15f + 0.85f * part();
  material.metallic = part();
  material.refraction = 1.01f + part();
  return material;
}

// Pieces of a triangle or of a gap have up to 400 samples, in some sceneries only one or two; materials change within
// vectors, and with them exponents or not.
Scenery random_scenery(shape::Random& random, int width) {
  Scenery scenery;
  for (const float exponent : {1.0f, 2.5f, 32.0f, 1000.0f, 0.5f, 0.0f})
    scenery.materials.push_back(random_material(random, exponent));
  if (random.whole(0, 2) == 0)
    for (wire::Material& material : scenery.materials) material.reflection = wire::Reflection::phong;
  if (random.whole(0, 2) == 0)
    for (wire::Material& material : scenery.materials) material.exponent = 32;
  if (random.whole(0, 1) == 0) scenery.ambient = random_ambient(random);
  if (random.whole(0, 1) == 0) scenery.fog = {{0.3f, 0.6f, 0.2f}, 1, 12};
  constexpr int kLongest[] = {2, 20, 400};
  const int longest = kLongest[random.whole(0, 2)];
  for (int k = 0; k < 20; ++k) scenery.triangles.push_back(random_triangle(random, scenery.materials.size()));
  for (int k = random.whole(0, 4); k > 0; --k) scenery.lights.push_back(random_light(random));
  scenery.line = static_cast<std::uint32_t>(random.whole(0, 479));
  while (scenery.ids.size() < static_cast<std::size_t>(width)) {
    const std::uint32_t id = random.whole(0, 4) ? static_cast<std::uint32_t>(random.whole(0, 19)) : kGap;
    scenery.ids.insert(scenery.ids.end(), static_cast<std::size_t>(random.whole(1, random.whole(1, longest))), id);
  }
  scenery.ids.resize(static_cast<std::size_t>(width));
  return scenery;
}

double at(const Triangle& t, shape::Value value, double dx, double dy) {
  return t.at_first[value] + dy * t.per_y[value] + dx * t.per_x[value];
}

shape::Vec3 unit(const shape::Vec3& a) {
  const double size = shape::length(a);
  return size > 0 ? shape::Vec3{a[0] / size, a[1] / size, a[2] / size} : shape::Vec3{};
}

// What the twin says of the triangle at (x, y), 1/256 pixel; 0..1.
shape::Vec3 plain(const Scenery& scenery, const Triangle& t, double x, double y) {
  const wire::Material& m = scenery.materials[t.material];
  const double dx = x - t.first_x, dy = y - t.first_y;
  const shape::Vec3 carried{at(t, shape::kNormalX, dx, dy), at(t, shape::kNormalY, dx, dy),
                            at(t, shape::kNormalZ, dx, dy)};
  const double w = 1 / at(t, shape::kDepth, dx, dy);
  const shape::Vec3 place{(x / 256 - scenery.view.center[0]) / scenery.view.scale * w,
                          -(y / 256 - scenery.view.center[1]) / scenery.view.scale * w, -w};
  const bool colored = m.interpolation != wire::Interpolation::phong;
  shape::Vec3 color = colored ? shape::Vec3{carried[0] * w, carried[1] * w, carried[2] * w}
                              : plain_light(scenery.shading(), m, {place, unit(carried)});
  color = plain_fog(scenery.fog, color, w);
  for (double& c : color) c = std::clamp(c, 0.0, 1.0);
  return color;
}

// Fragments of one line that jump between columns, triangles and samples.
std::vector<Fragment> random_fragments(shape::Random& random, int count) {
  std::vector<Fragment> fragments(static_cast<std::size_t>(count));
  for (Fragment& fragment : fragments)
    fragment = {static_cast<std::uint32_t>(random.whole(0, 19)), static_cast<std::uint16_t>(random.whole(0, 639)),
                static_cast<std::uint16_t>(random.whole(0, 15))};
  return fragments;
}

using Light = std::array<std::vector<float>, 3>;

Light shade_fragments(const Scenery& scenery, const std::vector<Fragment>& fragments, simd::InstructionSet set) {
  Light light;
  float* planes[3];
  for (std::size_t c = 0; c < 3; ++c) {
    light[c].resize(fragments.size() + simd::kVectorSlack);
    planes[c] = light[c].data();
  }
  shading_kernels(set).shade_fragments(scenery.shading(), fragments.data(),
                                       static_cast<std::uint32_t>(fragments.size()), scenery.line, planes);
  for (auto& plane : light) plane.resize(fragments.size());
  return light;
}

TEST(Shade, IsThePlainTwins) {
  shape::Random random(60);
  double worst = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Scenery scenery = random_scenery(random, random.whole(1, 640));
    const Result result = shade_all(scenery);
    std::size_t pixel = 0;
    for (std::uint32_t column = 0; column < scenery.ids.size(); ++column) {
      if (scenery.ids[column] == kGap) continue;
      const std::uint32_t value = result.pixels.at(pixel++);
      EXPECT_EQ(value >> 24, 0u);
      const shape::Vec3 right =
          plain(scenery, scenery.triangles[scenery.ids[column]], 256.0 * column + 128, 256.0 * scenery.line + 128);
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(255 * right[c] - static_cast<double>(value >> (8 * c) & 255)));
    }
    EXPECT_EQ(pixel, result.pixels.size());
  }
  EXPECT_LE(worst, 1.0);
}

TEST(Shade, FragmentsAreLitAtTheirOwnSamples) {
  shape::Random random(65);
  double worst = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Scenery scenery = random_scenery(random, 1);
    const auto fragments = random_fragments(random, random.whole(1, 700));
    const Light light = shade_fragments(scenery, fragments, simd::best_instruction_set(""));
    const shape::SamplePattern& pattern = shape::sample_pattern(16);
    for (std::size_t k = 0; k < fragments.size(); ++k) {
      const Fragment& f = fragments[k];
      const shape::Vec3 right = plain(scenery, scenery.triangles[f.triangle], 256.0 * f.column + pattern.x[f.sample],
                                      256.0 * scenery.line + pattern.y[f.sample]);
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(right[c] - static_cast<double>(light[c][k])));
    }
  }
  EXPECT_LE(worst, 0.5 / 255);
}

TEST(Shade, FragmentsHaveTheSameBitsEverywhere) {
  shape::Random random(66);
  for (int trial = 0; trial < 50; ++trial) {
    const Scenery scenery = random_scenery(random, 1);
    const auto fragments = random_fragments(random, random.whole(1, 700));
    const Light narrow = shade_fragments(scenery, fragments, simd::best_instruction_set("sse2"));
    for (const simd::InstructionSet set : simd::all_sets())
      EXPECT_EQ(shade_fragments(scenery, fragments, set), narrow) << simd::name_of(set) << ", trial " << trial;
  }
}

TEST(Shade, GivesTheSameBitsEverywhere) {
  shape::Random random(61);
  for (int trial = 0; trial < 150; ++trial) {
    const Scenery scenery = random_scenery(random, random.whole(1, 900));
    const Result narrow = shade_all(scenery, "sse2");
    for (const simd::InstructionSet set : simd::all_sets()) {
      const Result wide = shade_all(scenery, simd::name_of(set));
      EXPECT_EQ(wide.pixels, narrow.pixels) << simd::name_of(set) << ", trial " << trial;
    }
  }
}

// Whole batches, materials that change within them, and exact multiples of a batch.
TEST(Shade, RunsAreWhatIsWithoutGaps) {
  shape::Random random(62);
  for (int trial = 0; trial < 300; ++trial) {
    Scenery scenery = random_scenery(random, random.whole(1, 1100));
    if (trial % 4 == 0) std::fill_n(scenery.ids.begin(), scenery.ids.size() / 2, 0u);
    const auto width = static_cast<std::int32_t>(scenery.ids.size());
    const auto first = static_cast<std::uint32_t>(random.whole(0, width));
    const Extent extent{first, static_cast<std::uint32_t>(random.whole(static_cast<std::int32_t>(first), width))};
    std::vector<wire::Run> expected;
    std::size_t pixels = 0;
    for (std::uint32_t column = extent.first; column < extent.last; ++column) {
      if (scenery.ids[column] == kGap) continue;
      const bool begins = column == extent.first || scenery.ids[column - 1] == kGap;
      if (begins) expected.push_back({scenery.line, static_cast<std::uint16_t>(column), 0});
      ++expected.back().count;
      ++pixels;
    }
    const Result result = shade(scenery, simd::best_instruction_set(""), extent);
    EXPECT_EQ(result.pixels.size(), pixels);
    ASSERT_EQ(result.runs.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(result.runs[k].line, scenery.line);
      EXPECT_EQ(result.runs[k].first, expected[k].first);
      EXPECT_EQ(result.runs[k].count, expected[k].count);
    }
  }
}

// A pixel depends on its sample alone, not on what is shaded with it or where shading begins.
TEST(Shade, PartsOfALineAreThePartsOfTheWhole) {
  shape::Random random(63);
  for (int trial = 0; trial < 50; ++trial) {
    const Scenery scenery = random_scenery(random, 700);
    const Result whole = shade_all(scenery);
    std::vector<std::uint32_t> pieces;
    for (std::uint32_t first = 0; first < 700;) {
      const std::uint32_t last = std::min<std::uint32_t>(700, first + static_cast<std::uint32_t>(random.whole(1, 300)));
      const Result part = shade(scenery, simd::best_instruction_set(""), {first, last});
      pieces.insert(pieces.end(), part.pixels.begin(), part.pixels.end());
      first = last;
    }
    EXPECT_EQ(pieces, whole.pixels);
  }
}

TEST(Shade, NothingToShade) {
  shape::Random random(64);
  Scenery scenery = random_scenery(random, 20);
  EXPECT_TRUE(shade(scenery, simd::best_instruction_set(""), {0xffffffff, 0}).pixels.empty());
  std::fill(scenery.ids.begin(), scenery.ids.end(), kGap);
  EXPECT_TRUE(shade_all(scenery).runs.empty());
}

// What has no normal shows its ambient colour; what is lit too much shows white.
TEST(Shade, AmbientAndWhite) {
  Scenery scenery;
  scenery.materials = {{{1, 0.5f, 0}, 0.2f, 1, 1, 10, 2}, {{1, 1, 1}, 3, 1, 1, 10, 2}};
  scenery.triangles.resize(2);
  for (Triangle& t : scenery.triangles) set_plane(t, shape::kDepth, 1, 0, 0);
  scenery.triangles[1].material = 1;
  scenery.lights = {{wire::LightKind::directional, {0, 0, 1}, {1, 1, 1}, {}, 1, 1, 0}};
  scenery.ids = {0, 1};
  EXPECT_EQ(shade_all(scenery).pixels, (std::vector<std::uint32_t>{51 | 26 << 8, 0xffffff}));
}

}  // namespace
}  // namespace mars::shading
