#include "tests/bench/peers/png_encoder.h"

#include <cstring>
#include <stdexcept>

namespace mars::bench {
namespace {

using Bytes16 = std::uint8_t __attribute__((vector_size(16)));
constexpr std::uint32_t kTogether = 4;  // pixels

Bytes16 load(const std::uint32_t* pixels) {
  Bytes16 bytes;
  std::memcpy(&bytes, pixels, sizeof bytes);
  return bytes;
}

}  // namespace

std::vector<std::string> png_encoders() {
#ifdef MARS_BENCH_ISAL
  return {"libpng", "igzip"};
#else
  return {"libpng"};
#endif
}

std::unique_ptr<PngEncoder> make_png_encoder(const std::string& name, std::uint32_t width, std::uint32_t height) {
  if (name == "libpng") return make_libpng_encoder(width, height);
#ifdef MARS_BENCH_ISAL
  if (name == "igzip") return make_igzip_encoder(width, height);
#endif
  throw std::runtime_error("no such encoder was built in: " + name);
}

void pack_row(const std::uint32_t* pixels, const std::uint32_t* above, std::uint32_t width, std::uint8_t* row) {
  std::uint32_t x = 0;
  for (; x + kTogether <= width; x += kTogether, row += 3 * kTogether) {
    const Bytes16 bytes = above != nullptr ? load(pixels + x) - load(above + x) : load(pixels + x);
    const Bytes16 packed = __builtin_shufflevector(bytes, bytes, 0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15);
    std::memcpy(row, &packed, sizeof packed);
  }
  for (; x < width; ++x)
    for (int shift = 0; shift < 24; shift += 8)
      *row++ = static_cast<std::uint8_t>((pixels[x] >> shift) - (above != nullptr ? above[x] >> shift : 0));
}

}  // namespace mars::bench
