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
  if (wire::pixel_words(format) == 2) fill_pixels(words, plain, 2);
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

}  // namespace mars::compositor
