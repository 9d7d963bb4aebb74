// Files of frames, in any of their formats. Pixels have one word or two, as the format's have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "host/images/image.h"
#include "host/images/picture_format.h"

namespace mars::images {

// The bytes of such a file.
std::vector<std::byte> encode_picture(PictureFormat format, std::uint32_t width, std::uint32_t height,
                                      std::span<const std::uint32_t> pixels);

// Throws Failure naming the file where it is missing, torn or no such picture. Either format of PNG reads both.
Image read_picture(PictureFormat format, const std::filesystem::path& path);

}  // namespace mars::images
