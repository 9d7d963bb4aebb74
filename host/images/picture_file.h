// Files of frames, in any of their formats. Pixels have the words that files have of them (layers.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/images/image.h"
#include "host/images/picture_bands.h"
#include "host/images/picture_format.h"

namespace mars::images {

// The bytes of such a file. `note`: ASCII that it carries beside the pixels, at its beginning; "": none.
std::vector<std::byte> encode_picture(PictureFormat format, std::uint32_t width, std::uint32_t height,
                                      std::span<const std::uint32_t> pixels, const std::string& note = "");
std::vector<std::byte> encode_picture(const PictureBands& bands, std::span<const std::uint32_t> pixels,
                                      const FileFacts& facts);

// The note of the file, of any format, whose pixels are not read; none where it has none, or is no regular file.
std::optional<std::string> read_note(const std::filesystem::path& path);

// Throws Failure naming the file where it is missing, torn or no such picture. Either format of PNG reads both.
Image read_picture(PictureFormat format, const std::filesystem::path& path, wire::LayerSet layers = 0);

// Of a PNG file of frames, 8 bits a channel and no alpha: over black, where it has some.
Image read_opaque(const std::filesystem::path& path);

}  // namespace mars::images
