// Bands of EXR files (picture_bands.h): each is some of the file's chunks.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture_bands.h"

namespace mars::images {

// `pixels`: as files have them.
EncodedBand encode_exr_band(const PictureBands& bands, const Lines& lines, std::span<const std::uint32_t> pixels);
PictureEnds exr_ends(const PictureBands& bands, std::span<const BandPart> parts, const FileFacts& facts);

}  // namespace mars::images
