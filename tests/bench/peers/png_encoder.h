// Makes PNG files of pictures as a renderer without MARS would: by libpng, or by ISA-L's igzip, each set to be fast.
// README.md says which settings were tried.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mars::bench {

class PngEncoder {
 public:
  virtual ~PngEncoder() = default;
  // RGB of 8 bits. The file lives until the next call.
  virtual std::span<const std::uint8_t> encode(std::span<const std::uint32_t> pixels) = 0;
};

// Those that were built in.
std::vector<std::string> png_encoders();
// Throws std::runtime_error where it was not built in.
std::unique_ptr<PngEncoder> make_png_encoder(const std::string& name, std::uint32_t width, std::uint32_t height);

// For those that make a row's bytes themselves: pixels without their fourth byte, less those of `above` where there are
// any. Writes up to 4 bytes beyond the row.
void pack_row(const std::uint32_t* pixels, const std::uint32_t* above, std::uint32_t width, std::uint8_t* row);

std::unique_ptr<PngEncoder> make_libpng_encoder(std::uint32_t width, std::uint32_t height);
std::unique_ptr<PngEncoder> make_igzip_encoder(std::uint32_t width, std::uint32_t height);  // where MARS_BENCH_ISAL is

}  // namespace mars::bench
