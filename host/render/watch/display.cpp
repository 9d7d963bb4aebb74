#include "host/render/watch/display.h"

#include <algorithm>

#include "host/images/half_light.h"

namespace mars::watch {
namespace {

constexpr std::uint32_t kColors = 0x00ffffff;

std::uint64_t pixel_at(const std::uint32_t* words) { return words[0] | std::uint64_t{words[1]} << 32; }

std::uint32_t nearest_level8(std::uint64_t level16) {
  return static_cast<std::uint32_t>((level16 * 255 + 32767) / 65535);
}

float light_of(std::uint64_t half) { return images::light_of_half(static_cast<std::uint32_t>(half & 0xffff)); }

std::uint32_t shown16(std::uint64_t p) {
  return nearest_level8(p & 0xffff) | nearest_level8(p >> 16 & 0xffff) << 8 | nearest_level8(p >> 32 & 0xffff) << 16;
}

// `alpha`: 0..255.
std::uint32_t over(std::uint32_t color, std::uint32_t alpha, std::uint32_t background) {
  std::uint32_t shown = 0;
  for (int shift = 0; shift < 24; shift += 8) {
    const std::uint32_t sum = (color >> shift & 0xff) * alpha + (background >> shift & 0xff) * (255 - alpha);
    shown |= (sum + 127) / 255 << shift;
  }
  return shown;
}

}  // namespace

bool Display::begin_frame(std::uint32_t frame) {
  if (wire::colors_of(format_) != wire::PixelFormat::half && !wire::has_alpha(format_)) return false;
  const float before = encoding_.exposure;
  encoding_ = color::encoding_of(film_.settings(), film_.camera_at(frame), wire::PixelFormat::rgb8);
  background_ = static_cast<std::uint32_t>(color::pixel_of(encoding_, film_.settings().background.data()));
  return encoding_.exposure != before;
}

// Of half floats, with alpha or without: exactly what the film shows.
std::uint32_t Display::shown_light(std::uint64_t pixel) const {
  float light[] = {light_of(pixel), light_of(pixel >> 16), light_of(pixel >> 32)};
  const float open = 1 - light_of(pixel >> 48);
  if (wire::has_alpha(format_))
    for (std::size_t c = 0; c < 3; ++c) light[c] += open * film_.settings().background[c];
  return static_cast<std::uint32_t>(color::pixel_of(encoding_, light));
}

void Display::show(std::span<const std::uint32_t> words, std::uint32_t* pixels) const {
  const auto of_pairs = [&, step = wire::pixel_words(format_)](auto shown) {
    for (std::size_t at = 0; at < words.size(); at += step) *pixels++ = shown(pixel_at(&words[at]));
  };
  switch (wire::without_layers(format_)) {
    case wire::PixelFormat::rgb8:
      std::ranges::transform(words, pixels, [](std::uint32_t word) { return word & kColors; });
      break;
    case wire::PixelFormat::rgba8:
      std::ranges::transform(words, pixels, [&](std::uint32_t word) { return over(word, word >> 24, background_); });
      break;
    case wire::PixelFormat::rgb16: of_pairs(shown16); break;
    case wire::PixelFormat::rgba16:
      of_pairs([&](std::uint64_t p) { return over(shown16(p), nearest_level8(p >> 48), background_); });
      break;
    default: of_pairs([this](std::uint64_t p) { return shown_light(p); });
  }
}

}  // namespace mars::watch
