#include "host/render/watch/display.h"

#include <algorithm>
#include <bit>

namespace mars::watch {
namespace {

constexpr std::uint32_t kColors = 0x00ffffff;

std::uint64_t pixel_at(const std::uint32_t* words) { return words[0] | std::uint64_t{words[1]} << 32; }

std::uint32_t nearest_level8(std::uint64_t level16) {
  return static_cast<std::uint32_t>((level16 * 255 + 32767) / 65535);
}

// Of a half float that is not negative and finite.
float light_of(std::uint64_t half) {
  const auto bits = static_cast<std::uint32_t>(half & 0x7fff);
  if (bits < 0x400) return static_cast<float>(bits) * 0x1p-24f;
  return std::bit_cast<float>((bits << 13) + (112u << 23));
}

}  // namespace

bool Display::begin_frame(std::uint32_t frame) {
  if (format_ != wire::PixelFormat::half) return false;
  const float before = encoding_.exposure;
  encoding_ = color::encoding_of(film_.settings(), film_.camera_at(frame), wire::PixelFormat::rgb8);
  return encoding_.exposure != before;
}

void Display::show(std::span<const std::uint32_t> words, std::uint32_t* pixels) const {
  const auto of_pairs = [&](auto shown) {
    for (std::size_t at = 0; at < words.size(); at += 2) *pixels++ = shown(pixel_at(&words[at]));
  };
  switch (format_) {
    case wire::PixelFormat::rgb8:
      std::ranges::transform(words, pixels, [](std::uint32_t word) { return word & kColors; });
      break;
    case wire::PixelFormat::rgb16:
      of_pairs([](std::uint64_t p) {
        return nearest_level8(p & 0xffff) | nearest_level8(p >> 16 & 0xffff) << 8 |
               nearest_level8(p >> 32 & 0xffff) << 16;
      });
      break;
    case wire::PixelFormat::half:
      of_pairs([this](std::uint64_t p) {
        const float light[] = {light_of(p), light_of(p >> 16), light_of(p >> 32)};
        return static_cast<std::uint32_t>(color::pixel_of(encoding_, light));
      });
      break;
  }
}

}  // namespace mars::watch
