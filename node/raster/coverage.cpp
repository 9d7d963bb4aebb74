#include "node/raster/coverage.h"

#include <bit>
#include <cstddef>
#include <cstring>

namespace mars::raster {
namespace {

std::uint32_t covered(std::uint32_t mask) { return static_cast<std::uint32_t>(std::popcount(mask)); }

// Of `covered` of `samples` samples, in the format's lane: 0..255, 0..65535, or a half float, which has such shares
// exactly.
std::uint32_t alpha_of(wire::PixelFormat colors, std::uint32_t covered, std::uint32_t samples) {
  switch (colors) {
    case wire::PixelFormat::rgb8: return (255 * covered + samples / 2) / samples;
    case wire::PixelFormat::rgb16: return (65535 * covered + samples / 2) / samples;
    default: break;
  }
  if (covered == 0) return 0;
  const float share = static_cast<float>(covered) / static_cast<float>(samples);
  return (std::bit_cast<std::uint32_t>(share) - (112u << 23)) >> 13;
}

// Its place within the pixel, in bytes.
std::size_t lane_of(wire::PixelFormat colors) { return colors == wire::PixelFormat::rgb8 ? 3 : 6; }

void put(std::uint32_t alpha, wire::PixelFormat colors, std::size_t pixel, void* encoded) {
  std::byte* lane = static_cast<std::byte*>(encoded) + pixel * wire::pixel_bytes(colors) + lane_of(colors);
  std::memcpy(lane, &alpha, wire::pixel_bytes(colors) / 4);
}

}  // namespace

void divide_by_coverage(const color::Encoding& encoding, const std::uint32_t* masks, std::uint32_t pixels,
                        std::uint32_t samples, const Light& light) {
  if (encoding.format == wire::PixelFormat::half) return;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const std::uint32_t some = covered(masks[pixel]);
    if (some == 0 || some == samples) continue;
    const float whole = static_cast<float>(samples) / static_cast<float>(some);
    for (float* channel : light.channel) channel[pixel] *= whole;
  }
}

void put_alpha(const color::Encoding& encoding, const std::uint32_t* masks, std::uint32_t pixels, std::uint32_t samples,
               void* encoded) {
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
    put(alpha_of(encoding.format, covered(masks[pixel]), samples), encoding.format, pixel, encoded);
}

void put_opaque(const color::Encoding& encoding, std::uint32_t pixels, void* encoded) {
  const std::uint32_t opaque = alpha_of(encoding.format, 1, 1);
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) put(opaque, encoding.format, pixel, encoded);
}

}  // namespace mars::raster
