// From light to pixels: in linear films exposure, the curve and sRGB's encoding; coded films have colours that are
// shown as they are. Nodes encode what they draw (kernels.h), the host encodes the background, both to the same bits.
// Plain structs: kernels of several instruction sets share them.
#pragma once

#include <cstdint>

#include "node/color/agx_tables.h"
#include "node/color/srgb_tables.h"
#include "node/wire/film_parts.h"
#include "node/wire/pixel_format.h"

namespace mars::color {

struct Encoding {
  wire::ColorSpace space = wire::ColorSpace::coded;
  wire::Curve curve = wire::Curve::none;
  float exposure = 1;
  wire::PixelFormat format = wire::PixelFormat::rgb8;  // of colours; alpha is added to them (raster/coverage.h)
  bool alpha = false;
  // Of linear films: sRGB's levels (srgb_tables.h).
  const std::int32_t* srgb8 = nullptr;
  const std::int32_t* srgb16 = nullptr;
  AgxTables agx{};
};

// The filmic curve: light is shown as it is up to the shoulder; where the brightest of red, green and blue, m, exceeds
// it, all are scaled so that this becomes 1 - d^2 / (m + d - shoulder), d = 1 - shoulder, and then go towards white by
// 1 - 1 / (1 + bleach (m - what m became)). Mid-grey stays 0.18, white paper in light of 1 is shown as 0.88, a grey
// four stops above mid-grey as 0.98, and hues stay. This is Khronos's PBR Neutral Tone Mapper
// (github.com/KhronosGroup/ToneMapping/tree/main/PBR_Neutral) without its subtraction of 0.04, which undoes what white
// surroundings reflect.
inline constexpr float kShoulder = 0.76f;
inline constexpr float kBleach = 0.15f;

// Exposed light is cut here, far above all that differs from white.
inline constexpr float kMostExposed = 1e6f;

// The largest half float; more light is stored as it.
inline constexpr float kMostHalf = 65504.0f;

Encoding encoding_of(const wire::FilmSettings& settings, const wire::Camera& camera, wire::PixelFormat format);

// The nearest half float, ties to even; of a number beyond kMostHalf that or its negative.
std::uint32_t half_of(float value);

// The pixel of what surfaces leave open.
std::uint64_t background_pixel(const Encoding& encoding, const float* light);

// The pixel of `light` (red, green, blue; not negative) in its lowest pixel_bytes.
std::uint64_t pixel_of(const Encoding& encoding, const float* light);

}  // namespace mars::color
