#include "node/raster/coverage.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

namespace mars::raster {
namespace {

using wire::PixelFormat;

color::Encoding encoding(PixelFormat format) {
  color::Encoding encoding;
  encoding.format = wire::colors_of(format);
  encoding.alpha = true;
  return encoding;
}

std::uint64_t pixel(const std::vector<std::byte>& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at * size, size);
  return value;
}

TEST(Coverage, AlphaIsTheShareOfSamples) {
  const std::array<std::uint32_t, 4> masks{0, 0b1, 0b1011, 0b1111};
  std::vector<std::byte> pixels(masks.size() * 8);
  put_alpha(encoding(PixelFormat::rgba8), masks.data(), 4, 4, pixels.data());
  for (const auto& [at, alpha] : {std::pair{0u, 0u}, {1u, 64u}, {2u, 191u}, {3u, 255u}})
    EXPECT_EQ(pixel(pixels, at, 4), std::uint64_t{alpha} << 24);
  put_alpha(encoding(PixelFormat::rgba16), masks.data(), 4, 4, pixels.data());
  EXPECT_EQ(pixel(pixels, 1, 8) >> 48, 16384u);
  EXPECT_EQ(pixel(pixels, 3, 8) >> 48, 65535u);
  put_alpha(encoding(PixelFormat::half_alpha), masks.data(), 4, 4, pixels.data());
  for (const auto& [at, half] : {std::pair{0u, 0u}, {1u, 0x3400u}, {2u, 0x3a00u}, {3u, 0x3c00u}})
    EXPECT_EQ(pixel(pixels, at, 8) >> 48, half);
  put_opaque(encoding(PixelFormat::half_alpha), 2, pixels.data());
  EXPECT_EQ(pixel(pixels, 1, 8) >> 48, 0x3c00u);
}

TEST(Coverage, PngIsStraightAndExrPremultiplied) {
  const std::array<std::uint32_t, 3> masks{0b11, 0b1, 0};
  for (const PixelFormat format : {PixelFormat::rgba8, PixelFormat::rgba16, PixelFormat::half_alpha}) {
    std::array<std::array<float, 3>, 3> light{{{0.5f, 0.25f, 0}, {0.5f, 0.25f, 0}, {0.5f, 0.25f, 0}}};
    divide_by_coverage(encoding(format), masks.data(), 3, 2, {light[0].data(), light[1].data(), light[2].data()});
    const float second = format == PixelFormat::half_alpha ? 0.25f : 0.5f;
    for (const auto& channel : light)
      EXPECT_EQ(channel, (std::array<float, 3>{0.5f, second, 0})) << static_cast<int>(format);
  }
}

}  // namespace
}  // namespace mars::raster
