// File formats of frames, and the pixels that each holds.
#pragma once

#include <optional>
#include <string_view>

#include "node/wire/pixel_format.h"

namespace mars::images {

enum class PictureFormat { png, png16, exr };

struct FormatFacts {
  const char* name;    // as people write it
  const char* ending;  // of file names
  wire::PixelFormat pixels;
  const char* pixels_text;
};

const FormatFacts& facts_of(PictureFormat format);

// None where no format has this name.
std::optional<PictureFormat> picture_format_of(std::string_view name);

}  // namespace mars::images
