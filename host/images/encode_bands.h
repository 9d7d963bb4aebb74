// Encodes the bands of frames' files (picture_bands.h), in any format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture_bands.h"

namespace mars::images {

// `pixels`: of the band's lines.
EncodedBand encode_band(const PictureBands& bands, std::size_t band, std::span<const std::uint32_t> pixels);

// Of a file whose bands, all that the picture has, are `parts`.
PictureEnds ends_of(const PictureBands& bands, std::span<const BandPart> parts, const FileFacts& facts);

}  // namespace mars::images
