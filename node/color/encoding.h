// From light to pixels: in linear films exposure, the curve and sRGB's encoding; coded films have colours that are
// shown as they are. Nodes encode what they draw (kernels.h), the host encodes the background, both to the same bits.
// Plain structs: kernels of several instruction sets share them.
#pragma once

#include <cstdint>

#include "node/wire/film_parts.h"
#include "node/wire/pixel_format.h"

namespace mars::color {

struct Encoding {
  wire::ColorSpace space = wire::ColorSpace::coded;
  wire::Curve curve = wire::Curve::none;
  float exposure = 1;
  wire::PixelFormat format = wire::PixelFormat::rgb8;
};

Encoding encoding_of(const wire::FilmSettings& settings, const wire::Camera& camera, wire::PixelFormat format);

// The pixel of `light` (red, green, blue; not negative) in its lowest pixel_bytes.
std::uint64_t pixel_of(const Encoding& encoding, const float* light);

}  // namespace mars::color
