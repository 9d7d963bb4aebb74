// OpenEXR files: red, green and blue as half floats, of sRGB's primaries and white. The only place that knows OpenEXR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/images/image.h"

namespace mars::images {

// The bytes of an EXR file of `pixels`, two words each. `note`: ASCII that the file carries, in the string
// attribute `mars`; "": no such attribute.
std::vector<std::byte> encode_exr(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels,
                                  const std::string& note = "");

// The note of an EXR file that begins with these bytes; none where they hold no whole one.
std::optional<std::string> note_in_exr(std::span<const std::byte> start);

// Pixels have two words. Throws Failure naming the file where it is torn or no EXR of such channels.
Image decode_exr(std::span<const std::byte> bytes, const std::string& name);

}  // namespace mars::images
