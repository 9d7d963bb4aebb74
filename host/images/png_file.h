// Reads PNG files. The only place that knows libpng; png_bands.h writes frames' files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/images/image.h"

namespace mars::images {

// The note of a PNG file that begins with these bytes; none where they hold no whole one.
std::optional<std::string> note_in_png(std::span<const std::byte> start);

// Decodes an opaque PNG of any depth to 8 bits a channel. Throws Failure naming the file where it is torn or no PNG.
Image decode_png(std::span<const std::byte> bytes, const std::string& name);
// Decodes it to 16 bits a channel, two words a pixel.
Image decode_png16(std::span<const std::byte> bytes, const std::string& name);
// To 8 bits a channel, with alpha in the highest byte: 255 where the file has none.
Image decode_png_with_alpha(std::span<const std::byte> bytes, const std::string& name);
// To 16 bits a channel, with alpha in the highest 16: 65535 where the file has none.
Image decode_png16_with_alpha(std::span<const std::byte> bytes, const std::string& name);

}  // namespace mars::images
