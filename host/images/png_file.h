// PNG files: 8-bit RGB marked sRGB. The only place that knows libpng.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace mars::images {

// Rows from the top, each pixel red in the lowest byte, then green, blue, 0.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint32_t> pixels;
};

// The bytes of a PNG file of these pixels, made fast rather than small.
std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels);

// Decodes an opaque PNG of any depth to 8 bits a channel. Throws Failure naming the file where it is missing,
// torn or no PNG.
Image read_png(const std::filesystem::path& path);
// Likewise from a file's bytes; `name` stands for the file in failures.
Image decode_png(std::span<const std::byte> bytes, const std::string& name);

}  // namespace mars::images
