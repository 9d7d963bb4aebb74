// Pictures with alpha against the same pictures over their background.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

using wire::PixelFormat;

Pixels drawn(const wire::FilmData& film, PixelFormat format) {
  RunOptions options;
  options.nodes = 2;
  options.format = format;
  return run_film(FilmBlock(film).bytes(), options).frames.at(1);
}

double half_at(const Pixels& pixels, std::size_t pixel, std::size_t channel) {
  const std::uint32_t word = pixels[2 * pixel + channel / 2], half = channel % 2 == 0 ? word & 0xffff : word >> 16;
  const int exponent = static_cast<int>(half >> 10);
  return exponent == 0 ? std::ldexp(half & 1023, -24) : std::ldexp(1024 + (half & 1023), exponent - 25);
}

TEST(Alpha, OfLightIsPremultiplied) {
  for (const std::uint32_t samples : {1u, 4u, 16u}) {
    const wire::FilmData film = richly_lit(with_samples(crowd(97, 61, 2, 2), samples));
    const Pixels opaque = drawn(film, PixelFormat::half), alpha = drawn(film, PixelFormat::half_alpha);
    std::size_t partly = 0, open = 0;
    for (std::size_t pixel = 0; pixel < std::size_t{97} * 61; ++pixel) {
      const double covered = half_at(alpha, pixel, 3);
      ASSERT_EQ(covered * samples, std::round(covered * samples)) << "a share of the samples";
      partly += covered > 0 && covered < 1;
      open += covered == 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double over = half_at(alpha, pixel, c) + (1 - covered) * static_cast<double>(film.settings.background[c]);
        ASSERT_NEAR(over, half_at(opaque, pixel, c), 1e-4 + over / 1000) << pixel;
      }
    }
    EXPECT_GT(open, 100u);
    EXPECT_EQ(partly > 50, samples > 1);
  }
}

TEST(Alpha, OfLevelsIsStraight) {
  wire::FilmData film = with_samples(crowd(97, 61, 2, 2), 4);
  const Pixels opaque = drawn(film, PixelFormat::rgb8), alpha = drawn(film, PixelFormat::rgba8);
  std::ranges::fill(film.settings.background, 0.0f);
  const Pixels over_black = drawn(film, PixelFormat::rgb8);
  std::size_t partly = 0;
  for (std::size_t pixel = 0; pixel < opaque.size(); ++pixel) {
    const std::uint32_t covered = alpha[pixel] >> 24, color = alpha[pixel] & 0xffffff;
    if (covered == 0 || covered == 255) {
      ASSERT_EQ(color, covered == 0 ? 0u : opaque[pixel]);
      continue;
    }
    ++partly;
    for (int shift = 0; shift < 24; shift += 8)
      ASSERT_NEAR((color >> shift & 255) * covered / 255.0, over_black[pixel] >> shift & 255, 1.01) << pixel;
  }
  EXPECT_GT(partly, 50u);
}

}  // namespace
}  // namespace mars::test
