// OpenEXR files: red, green, blue and where it is asked for alpha, which multiplies them, as half floats, of sRGB's
// primaries and white, and a note in the string attribute `mars`. exr_file.cpp is the only place that knows OpenEXR;
// exr_bands.h writes such files. The file's data window is what it has of the film's picture, its display window all of
// that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/images/image.h"

namespace mars::images {

// The note of an EXR file that begins with these bytes; none where they hold no whole one.
std::optional<std::string> note_in_exr(std::span<const std::byte> start);

// Pixels have two words, with alpha where that is asked for: 1 where the file has none. Throws Failure naming the file
// where it is torn or no EXR of such channels.
Image decode_exr(std::span<const std::byte> bytes, const std::string& name, bool alpha = false);

}  // namespace mars::images
