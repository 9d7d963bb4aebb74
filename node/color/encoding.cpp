#include "node/color/encoding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace mars::color {
namespace {

using Color = std::array<float, 3>;

void apply_filmic_curve(Color& color) {
  const float brightest = std::max(color[0], std::max(color[1], color[2]));
  if (brightest <= kShoulder) return;
  constexpr float kRest = 1.0f - kShoulder;
  const float shown = 1.0f - kRest * kRest / ((brightest + kRest) - kShoulder);
  const float scale = shown / brightest;
  const float kept = 1.0f / (kBleach * (brightest - shown) + 1.0f);
  for (float& c : color) c = (c * scale - shown) * kept + shown;
}

Color mixed(const float (&rows)[3][3], const Color& color) {
  Color out{};
  for (std::size_t c = 0; c < 3; ++c) out[c] = (rows[c][0] * color[0] + rows[c][1] * color[1]) + rows[c][2] * color[2];
  return out;
}

float between(const float* entry, float part) { return entry[0] + (entry[1] - entry[0]) * part; }

void apply_agx(const AgxTables& tables, Color& color) {
  color = mixed(kAgxInset, color);
  for (float& c : color) {
    const float light = std::min(std::max(c, kAgxDarkest), kAgxBrightest);
    const std::uint32_t beyond = std::bit_cast<std::uint32_t>(light) - std::bit_cast<std::uint32_t>(kAgxDarkest);
    constexpr std::uint32_t kEntry = 1u << kAgxEntryBits;
    c = between(&tables.curve[beyond / kEntry], static_cast<float>(beyond % kEntry) * (1.0f / kEntry));
  }
  color = mixed(kAgxOutset, color);
  for (float& c : color) {
    const float step = std::min(std::max(c, 0.0f), 1.0f) * float{kAgxSteps};
    const auto entry = static_cast<std::uint32_t>(step);
    c = between(&tables.power[entry], step - static_cast<float>(entry));
  }
}

std::uint32_t nearest(float value) { return static_cast<std::uint32_t>(value + 0.5f); }

// Light that the film is to show, 0..1.
Color shown(const Encoding& encoding, const float* light) {
  Color color{light[0], light[1], light[2]};
  if (encoding.space == wire::ColorSpace::linear) {
    for (float& c : color) c = std::min(c * encoding.exposure, kMostExposed);
    if (encoding.curve == wire::Curve::filmic) apply_filmic_curve(color);
    if (encoding.curve == wire::Curve::agx) apply_agx(encoding.agx, color);
  }
  for (float& c : color) c = std::min(std::max(c, 0.0f), 1.0f);
  return color;
}

std::uint32_t level8(const Encoding& encoding, float y) {
  if (encoding.space == wire::ColorSpace::coded) return nearest(y * 255.0f);
  return static_cast<std::uint32_t>(encoding.srgb8[nearest(std::sqrt(y) * float{kSteps8})]);
}

std::uint32_t level16(const Encoding& encoding, float y) {
  if (encoding.space == wire::ColorSpace::coded) return nearest(y * 65535.0f);
  return static_cast<std::uint32_t>(encoding.srgb16[nearest(std::sqrt(y) * float{kSteps16})]);
}

std::uint32_t half_of_positive(float value) {
  const float cut = std::min(value, kMostHalf);
  if (cut < 0x1p-14f) return std::bit_cast<std::uint32_t>(cut + 0.5f) - std::bit_cast<std::uint32_t>(0.5f);
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(cut) - (112u << 23);
  return (bits + 0xfff + (bits >> 13 & 1)) >> 13;
}

std::uint64_t packed(std::uint64_t red, std::uint64_t green, std::uint64_t blue, int bits) {
  return red | green << bits | blue << 2 * bits;
}

}  // namespace

Encoding encoding_of(const wire::FilmSettings& settings, const wire::Camera& camera, wire::PixelFormat format) {
  return {settings.color_space,
          settings.curve,
          static_cast<float>(camera.exposure),
          wire::colors_of(format),
          wire::has_alpha(format),
          srgb_levels8(),
          srgb_levels16(),
          agx_tables()};
}

std::uint32_t half_of(float value) { return half_of_positive(std::abs(value)) | (std::signbit(value) ? 0x8000u : 0u); }

std::uint64_t background_pixel(const Encoding& encoding, const float* light) {
  return encoding.alpha ? 0 : pixel_of(encoding, light);
}

std::uint64_t pixel_of(const Encoding& encoding, const float* light) {
  if (encoding.format == wire::PixelFormat::half)
    return packed(half_of_positive(light[0]), half_of_positive(light[1]), half_of_positive(light[2]), 16);
  const Color y = shown(encoding, light);
  if (encoding.format == wire::PixelFormat::rgb16)
    return packed(level16(encoding, y[0]), level16(encoding, y[1]), level16(encoding, y[2]), 16);
  return packed(level8(encoding, y[0]), level8(encoding, y[1]), level8(encoding, y[2]), 8);
}

}  // namespace mars::color
