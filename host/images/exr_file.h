// OpenEXR files: red, green and blue as half floats, of sRGB's primaries and white. The only place that knows OpenEXR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/images/image.h"

namespace mars::images {

// The bytes of an EXR file of these pixels, two words each.
std::vector<std::byte> encode_exr(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels);

// Pixels have two words. Throws Failure naming the file where it is torn or no EXR of such channels.
Image decode_exr(std::span<const std::byte> bytes, const std::string& name);

}  // namespace mars::images
