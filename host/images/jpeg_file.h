// JPEG files, as other programs' textures are. A MARS that was built without libjpeg-turbo (no_jpeg_file.cpp) refuses
// them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "host/images/image.h"

namespace mars::images {

// Throws Failure naming the file where it is torn or no JPEG of grey or colours.
Image decode_jpeg(std::span<const std::byte> bytes, const std::string& name);

}  // namespace mars::images
