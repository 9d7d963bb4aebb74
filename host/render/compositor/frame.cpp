#include "host/render/compositor/frame.h"

#include <cstddef>
#include <span>

#include "hal/messages/pages.h"

namespace mars::compositor {
namespace {

// In large pages, of which a picture takes a few.
std::vector<std::uint32_t> plain_pixels(std::size_t count, std::uint32_t plain) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(count);
  messages::prefer_large_pages(std::as_writable_bytes(std::span(pixels.data(), count)));
  pixels.assign(count, plain);
  return pixels;
}

}  // namespace

Frame::Frame(std::uint32_t width, std::uint32_t height, std::uint32_t block, std::uint32_t plain)
    : width(width),
      height(height),
      pixels(plain_pixels(std::size_t{width} * height, plain)),
      changed(width, height, block),
      plain(plain),
      constant(width, height, block),
      overwritten(width, height, block),
      stale(width, height, block) {}

}  // namespace mars::compositor
