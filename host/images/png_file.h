// PNG files: RGB of 8 or 16 bits marked sRGB. The only place that knows libpng.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/images/image.h"

namespace mars::images {

// The bytes of a PNG file of `pixels`, made fast rather than small. `note`: ASCII that the file carries, in a tEXt
// chunk of the keyword MARS before the pixels; "": no such chunk.
std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels,
                                  const std::string& note = "");
// Of pixels of two words, 16 bits a channel.
std::vector<std::byte> encode_png16(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels,
                                    const std::string& note = "");

// The note of a PNG file that begins with these bytes; none where they hold no whole one.
std::optional<std::string> note_in_png(std::span<const std::byte> start);

// Decodes an opaque PNG of any depth to 8 bits a channel. Throws Failure naming the file where it is torn or no PNG.
Image decode_png(std::span<const std::byte> bytes, const std::string& name);
// Decodes it to 16 bits a channel, two words a pixel.
Image decode_png16(std::span<const std::byte> bytes, const std::string& name);
// To 8 bits a channel, with alpha in the highest byte: 255 where the file has none.
Image decode_png_with_alpha(std::span<const std::byte> bytes, const std::string& name);

}  // namespace mars::images
