#include <png.h>
#include <zlib.h>

#include <stdexcept>

#include "tests/bench/peers/png_encoder.h"

namespace mars::bench {
namespace {

constexpr std::size_t kChunk = 1 << 20;  // bytes of compressed data

[[noreturn]] void on_error(png_structp, png_const_charp reason) {
  throw std::runtime_error(std::string("libpng: ") + reason);
}

void append(png_structp png, png_bytep bytes, png_size_t count) {
  auto& file = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  file.insert(file.end(), bytes, bytes + count);
}

class LibpngEncoder : public PngEncoder {
 public:
  LibpngEncoder(std::uint32_t width, std::uint32_t height)
      : width_(width), height_(height), row_(std::size_t{3} * width + 4) {}

  std::span<const std::uint8_t> encode(std::span<const std::uint32_t> pixels) override {
    file_.clear();
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file_, append, nullptr);
    png_set_IHDR(png, info, width_, height_, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_buffer_size(png, kChunk);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, Z_RLE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_write_info(png, info);
    for (std::size_t y = 0; y < height_; ++y) {
      pack_row(&pixels[y * width_], nullptr, width_, row_.data());
      png_write_row(png, row_.data());
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file_;
  }

 private:
  const std::uint32_t width_, height_;
  std::vector<std::uint8_t> row_, file_;
};

}  // namespace

std::unique_ptr<PngEncoder> make_libpng_encoder(std::uint32_t width, std::uint32_t height) {
  return std::make_unique<LibpngEncoder>(width, height);
}

}  // namespace mars::bench
