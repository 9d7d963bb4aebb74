// From light to pixels: sRGB's tables against the formula, the curve's promises, half floats against the compiler's,
// and the kernels against the plain pixel_of.
#include "node/color/encoding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "node/color/kernels.h"
#include "node/color/srgb_tables.h"
#include "node/simd/vector_slack.h"
#include "tests/node/shape/patches.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::color {
namespace {

using shape::Random;
using wire::ColorSpace, wire::Curve, wire::PixelFormat;

constexpr PixelFormat kFormats[] = {PixelFormat::rgb8, PixelFormat::rgb16, PixelFormat::half};

Encoding encoding(ColorSpace space, Curve curve, float exposure, PixelFormat format) {
  wire::FilmSettings settings{};
  settings.color_space = space;
  settings.curve = curve;
  wire::Camera camera{};
  camera.exposure = exposure;
  return encoding_of(settings, camera, format);
}

double srgb(double y) { return y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1 / 2.4) - 0.055; }

void expect_srgb(std::span<const std::int32_t> table, double most) {
  const std::size_t steps = table.size() - 1;
  EXPECT_EQ(table.front(), 0);
  EXPECT_EQ(table.back(), most);
  EXPECT_TRUE(std::is_sorted(table.begin(), table.end()));
  double worst = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double root = static_cast<double>(i) / static_cast<double>(steps);
    worst = std::max(worst, std::abs(table[i] - most * srgb(root * root)));
  }
  EXPECT_LE(worst, 0.5 + 1e-9);
}

TEST(Encoding, TablesAreSrgb) {
  expect_srgb({srgb_levels8(), kSteps8 + 1}, 255);
  expect_srgb({srgb_levels16(), kSteps16 + 1}, 65535);
}

// Between two places of the table sRGB rises by less than a tenth of a level.
TEST(Encoding, StepsOfTheTableAreFine) {
  for (std::uint32_t i = 0; i < kSteps8; ++i) {
    const double here = i / double{kSteps8}, next = (i + 1) / double{kSteps8};
    EXPECT_LT(255 * (srgb(next * next) - srgb(here * here)), 0.1) << i;
  }
}

TEST(Encoding, CodedColoursAreLevels) {
  const Encoding coded = encoding(ColorSpace::coded, Curve::filmic, 7, PixelFormat::rgb8);
  const float light[] = {0.2f, 1.7f, 0.1019f};
  EXPECT_EQ(pixel_of(coded, light), 51u | 255u << 8 | 26u << 16);
  EXPECT_EQ(pixel_of(encoding(ColorSpace::coded, Curve::none, 7, PixelFormat::rgb16), light),
            13107u | 65535ull << 16 | 6678ull << 32);
}

TEST(Encoding, ExposureScalesLight) {
  const float light[] = {0.1f, 0.2f, 0.05f}, brighter[] = {0.2f, 0.4f, 0.1f};
  for (const Curve curve : {Curve::none, Curve::filmic})
    EXPECT_EQ(pixel_of(encoding(ColorSpace::linear, curve, 2, PixelFormat::rgb16), light),
              pixel_of(encoding(ColorSpace::linear, curve, 1, PixelFormat::rgb16), brighter));
}

// Red, green and blue of 16 bits.
std::array<double, 3> channels(std::uint64_t pixel) {
  return {static_cast<double>(pixel & 65535), static_cast<double>(pixel >> 16 & 65535),
          static_cast<double>(pixel >> 32 & 65535)};
}

std::array<double, 3> filmic(float red, float green, float blue) {
  const float light[] = {red, green, blue};
  return channels(pixel_of(encoding(ColorSpace::linear, Curve::filmic, 1, PixelFormat::rgb16), light));
}

TEST(Encoding, FilmicCurveKeepsGreysAndRisesToWhite) {
  EXPECT_NEAR(filmic(0.18f, 0.18f, 0.18f)[0], 65535 * srgb(0.18), 2);
  EXPECT_NEAR(filmic(2.88f, 2.88f, 2.88f)[0], 65535 * srgb(1 - 0.24 * 0.24 / (2.88 + 0.24 - 0.76)), 2);
  double before = 0;
  for (float light = 0; light < 20; light += 0.01f) {
    const double shown = filmic(light, light, light)[0];
    EXPECT_GE(shown, before) << light;
    EXPECT_LE(shown, 65535) << light;
    before = shown;
  }
  const std::array<double, 3> white{65535, 65535, 65535};
  EXPECT_EQ(filmic(3e38f, 3e38f, 3e38f), white);
}

// Bright colours grow paler, but the order of their channels stays.
TEST(Encoding, FilmicCurveKeepsHues) {
  for (const float scale : {1.0f, 3.0f, 10.0f, 100.0f}) {
    const auto shown = filmic(scale, 0.4f * scale, 0.1f * scale);
    EXPECT_GT(shown[0], shown[1]) << scale;
    EXPECT_GT(shown[1], shown[2]) << scale;
  }
  EXPECT_GT(filmic(10, 4, 1)[2], filmic(1, 0.4f, 0.1f)[2]);
}

std::uint32_t half(float value) {
  const float light[] = {value, 0, 0};
  return static_cast<std::uint32_t>(pixel_of(encoding(ColorSpace::linear, Curve::filmic, 4, PixelFormat::half), light));
}

// What a half float's bits stand for.
double value_of(std::uint32_t bits) {
  const int exponent = static_cast<int>(bits >> 10);
  const double fraction = bits & 1023;
  return exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
}

// Of every half float, of the float in the middle between it and the next, and of the floats beside that.
TEST(Encoding, HalvesAreTheNearest) {
  for (std::uint32_t bits = 0; bits < 0x7bff; ++bits) {
    const float own = static_cast<float>(value_of(bits)), next = static_cast<float>(value_of(bits + 1));
    const float middle = (own + next) / 2;
    ASSERT_EQ(half(own), bits);
    ASSERT_EQ(half(std::nextafter(middle, 0.0f)), bits);
    ASSERT_EQ(half(middle), bits + (bits & 1));
    ASSERT_EQ(half(std::nextafter(middle, next)), bits + 1);
  }
  EXPECT_EQ(half(65504), 0x7bffu);
  EXPECT_EQ(half(65535), 0x7bffu);
  EXPECT_EQ(half(std::numeric_limits<float>::infinity()), 0x7bffu);
  EXPECT_EQ(half(std::numeric_limits<float>::denorm_min()), 0u);
}

// Light of all sizes.
std::vector<float> some_light(Random& random, std::size_t count) {
  std::vector<float> light(count);
  for (float& value : light) {
    const double size = std::ldexp(random.real(0.5, 1), random.whole(-30, 20));
    value = random.whole(0, 9) == 0 ? static_cast<float>(random.whole(0, 1)) : static_cast<float>(size);
  }
  return light;
}

// The kernel's pixels, in memory that it may write and no more. What whole vectors write behind them is black: the
// light there is anyone's, and valgrind counts whatever depends on it.
std::vector<std::uint64_t> encode(simd::InstructionSet set, const Encoding& how, const std::vector<float>* light,
                                  std::uint32_t count) {
  const std::size_t bytes = wire::pixel_bytes(how.format);
  std::vector<std::uint8_t> memory((count + simd::kVectorSlack) * bytes + 64, 0xa5);
  const float* planes[] = {light[0].data(), light[1].data(), light[2].data()};
  color_kernels(set).encode(how, planes, count, memory.data());
  EXPECT_TRUE(std::all_of(memory.end() - 64, memory.end(), [](auto byte) { return byte == 0xa5; }));
  for (const std::uint8_t byte : std::span(memory).subspan(count * bytes)) EXPECT_TRUE(byte == 0xa5 || byte == 0);
  std::vector<std::uint64_t> pixels(count, 0);
  for (std::uint32_t k = 0; k < count; ++k) std::memcpy(&pixels[k], &memory[k * bytes], bytes);
  return pixels;
}

void expect_plain_pixels(Random& random, const Encoding& how) {
  const auto count = static_cast<std::uint32_t>(random.whole(0, 300));
  const std::size_t size = count + simd::kVectorSlack;
  const std::vector<float> light[] = {some_light(random, size), some_light(random, size), some_light(random, size)};
  std::vector<std::uint64_t> plain(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const float here[] = {light[0][k], light[1][k], light[2][k]};
    plain[k] = pixel_of(how, here);
  }
  for (const simd::InstructionSet set : simd::all_sets())
    EXPECT_EQ(encode(set, how, light, count), plain) << simd::name_of(set);
}

// As https://iolite-engine.com/blog_posts/minimal_agx_implementation has it, in doubles.
std::array<double, 3> agx_twin(const std::array<double, 3>& light) {
  const auto mixed = [](const double(&columns)[9], const std::array<double, 3>& v) {
    std::array<double, 3> out{};
    for (std::size_t row = 0; row < 3; ++row)
      out[row] = columns[row] * v[0] + columns[3 + row] * v[1] + columns[6 + row] * v[2];
    return out;
  };
  static constexpr double kIn[] = {0.842479062253094,  0.0423282422610123, 0.0423756549057051,
                                   0.0784335999999992, 0.878468636469772,  0.0784336,
                                   0.0792237451477643, 0.0791661274605434, 0.879142973793104};
  static constexpr double kOut[] = {1.19687900512017,    -0.0528968517574562, -0.0529716355144438,
                                    -0.0980208811401368, 1.15190312990417,    -0.0980434501171241,
                                    -0.0990297440797205, -0.0989611768448433, 1.15107367264116};
  std::array<double, 3> value = mixed(kIn, light);
  for (double& v : value) {
    const double x =
        (std::clamp(std::log2(std::max(v, 1e-10)), -12.47393, 4.026069) + 12.47393) / (4.026069 + 12.47393);
    v = 15.5 * std::pow(x, 6) - 40.14 * std::pow(x, 5) + 31.96 * std::pow(x, 4) - 6.868 * std::pow(x, 3) +
        0.4298 * x * x + 0.1191 * x - 0.00232;
  }
  value = mixed(kOut, value);
  for (double& v : value) v = 65535 * srgb(std::pow(std::clamp(v, 0.0, 1.0), 2.2));
  return value;
}

TEST(Encoding, AgxIsItsPublicForm) {
  Random random(71);
  const Encoding agx = encoding(ColorSpace::linear, Curve::agx, 1, PixelFormat::rgb16);
  for (int trial = 0; trial < 20'000; ++trial) {
    float light[3];
    for (float& c : light) c = static_cast<float>(std::exp2(random.real(-16, 6)));
    const auto shown = channels(pixel_of(agx, light)), twin = agx_twin({light[0], light[1], light[2]});
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(shown[c], twin[c], 8) << light[0] << " " << light[1] << " " << light[2];
  }
}

TEST(Encoding, AgxRisesToWhite) {
  double before = -1;
  const Encoding agx = encoding(ColorSpace::linear, Curve::agx, 1, PixelFormat::rgb16);
  for (float light = 0; light < 20; light += 0.01f) {
    const float grey[] = {light, light, light};
    const double shown = channels(pixel_of(agx, grey))[0];
    ASSERT_GE(shown, before) << light;
    before = shown;
  }
  EXPECT_GT(before, 64000) << "white";
  const float red[] = {50, 0, 0};
  EXPECT_GT(channels(pixel_of(agx, red))[1], 20000) << "bright red goes towards white";
  const float most[] = {3e38f, 3e38f, 3e38f};
  EXPECT_EQ(channels(pixel_of(agx, most))[0], before);
}

TEST(Encoding, AlphaLeavesColoursAlone) {
  wire::FilmSettings settings{};
  const Encoding rgba = encoding_of(settings, {}, PixelFormat::rgba16),
                 rgb = encoding_of(settings, {}, PixelFormat::rgb16);
  const float light[] = {0.1f, 0.2f, 0.3f};
  EXPECT_EQ(pixel_of(rgba, light), pixel_of(rgb, light));
  EXPECT_EQ(background_pixel(rgba, light), 0u);
  EXPECT_EQ(background_pixel(rgb, light), pixel_of(rgb, light));
}

TEST(Encoding, KernelsMakePlainPixels) {
  Random random(70);
  for (int trial = 0; trial < 40; ++trial)
    for (const PixelFormat format : kFormats) {
      const auto exposure = static_cast<float>(random.real(0.1, 8));
      expect_plain_pixels(random, encoding(ColorSpace::coded, Curve::none, exposure, format));
      expect_plain_pixels(random, encoding(ColorSpace::linear, Curve::none, exposure, format));
      expect_plain_pixels(random, encoding(ColorSpace::linear, Curve::filmic, exposure, format));
      expect_plain_pixels(random, encoding(ColorSpace::linear, Curve::agx, exposure, format));
    }
}

}  // namespace
}  // namespace mars::color
