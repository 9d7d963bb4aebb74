#include "host/render/compositor/frame.h"

#include <cstddef>
#include <span>

#include "hal/messages/pages.h"
#include "host/render/compositor/plain_pixels.h"

namespace mars::compositor {
namespace {

// In large pages, of which a picture takes a few.
std::vector<std::uint32_t> plain_picture(std::size_t pixels, std::uint64_t plain, wire::PixelFormat format) {
  const std::size_t count = pixels * wire::pixel_words(format);
  std::vector<std::uint32_t> words;
  words.reserve(count);
  messages::prefer_large_pages(std::as_writable_bytes(std::span(words.data(), count)));
  words.assign(count, static_cast<std::uint32_t>(plain));
  if (wire::pixel_words(format) > 1) fill_pixels(words, plain, format);
  return words;
}

}  // namespace

Frame::Frame(std::uint32_t width, std::uint32_t height, std::uint32_t block, std::uint64_t plain,
             wire::PixelFormat format)
    : width(width),
      height(height),
      format(format),
      pixels(plain_picture(std::size_t{width} * height, plain, format)),
      changed(width, height, block),
      plain(plain),
      constant(width, height, block),
      overwritten(width, height, block),
      stale(width, height, block) {}

bool Frame::shows_background(const Lines& lines) const {
  const std::uint32_t block = overwritten.block();
  for (std::uint32_t row = lines.first / block; row * block < lines.end; ++row)
    if (overwritten.any(row)) return false;
  return true;
}

std::uint64_t Frame::restore(const Lines& lines) {
  const std::uint32_t block = stale.block();
  std::uint64_t bytes = 0;
  for (std::uint32_t row = lines.first / block; row * block < lines.end; ++row) {
    stale.for_stretches(
        row, [&](std::uint32_t first, std::uint32_t last) { bytes += shown->write(pixels.data(), row, first, last); });
    stale.clear_row(row);
  }
  return bytes;
}

}  // namespace mars::compositor
