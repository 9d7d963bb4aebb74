// Alpha: the share of a pixel's samples that surfaces cover, in place of the zero that pixels have otherwise
// (node/wire/pixel_format.h).
#pragma once

#include <cstdint>

#include "node/color/encoding.h"
#include "node/raster/kernels.h"

namespace mars::raster {

// What `pixels` pixels with alpha show before they are encoded: of `light`, the sum over the covered samples by their
// share of all `samples`, what alpha does not multiply, where the format has it so.
void divide_by_coverage(const color::Encoding& encoding, const std::uint32_t* masks, std::uint32_t pixels,
                        std::uint32_t samples, const Light& light);

// Adds alpha to `pixels` encoded pixels whose masks have a bit for each covered sample.
void put_alpha(const color::Encoding& encoding, const std::uint32_t* masks, std::uint32_t pixels, std::uint32_t samples,
               void* encoded);
// To pixels that are covered.
void put_opaque(const color::Encoding& encoding, std::uint32_t pixels, void* encoded);

}  // namespace mars::raster
