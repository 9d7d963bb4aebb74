// Bands of PNG files (picture_bands.h): each is a chunk of the picture's one stream of data, which begins with a whole
// byte and with a row that is not compared with the one above.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/images/picture_bands.h"
#include "node/wire/pixel_format.h"

namespace mars::images {

inline constexpr const char* kPngNoteKeyword = "MARS";  // of the tEXt chunk

EncodedBand encode_png_band(std::uint32_t width, wire::PixelFormat format, std::span<const std::uint32_t> pixels);
PictureEnds png_ends(const PictureBands& bands, std::span<const BandPart> parts, const FileFacts& facts);

}  // namespace mars::images
