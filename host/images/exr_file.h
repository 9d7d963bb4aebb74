// OpenEXR files: red, green, blue and where it is asked for alpha, which multiplies them, as half floats, of sRGB's
// primaries and white; layers (layers.h); and a note in the string attribute `mars`. The file's data window is what it
// has of the film's picture, its display window all of that. exr_file.cpp is the only place that knows OpenEXR;
// exr_bands.h writes such files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/images/image.h"
#include "node/wire/pixel_format.h"

namespace mars::images {

// Throws Failure where MARS was built without OpenEXR, as all functions do then that are given an EXR file.
void check_exr_is_built();

// The note of an EXR file that begins with these bytes; none where they hold no whole one.
std::optional<std::string> note_in_exr(std::span<const std::byte> start);

// Pixels as files have them of pictures in this format (layers.h), of half floats; alpha is 1 where the file has none.
// Throws Failure naming the file where it is torn or lacks channels.
Image decode_exr(std::span<const std::byte> bytes, const std::string& name,
                 wire::PixelFormat format = wire::PixelFormat::half);

}  // namespace mars::images
