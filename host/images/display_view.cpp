#include "host/images/display_view.h"

#include <algorithm>
#include <cmath>

#include "host/images/half_light.h"

namespace mars::images {
namespace {

// No number counts as none.
std::uint32_t level_of(float shown, std::uint32_t most) {
  const float inside = shown > 0 ? std::min(shown, 1.0f) : 0.0f;
  return static_cast<std::uint32_t>(std::lround(inside * static_cast<float>(most)));
}

}  // namespace

std::string text_of(const ViewName& name) {
  return "the view " + name.view + " of " + name.input + " on the display " + name.display + " in " + name.config;
}

std::vector<std::uint32_t> shown_pixels(const DisplayView& view, std::span<const std::uint32_t> light, float exposure,
                                        wire::PixelFormat format) {
  const std::size_t count = light.size() / 2;
  const bool alpha = wire::has_alpha(format), wide = wire::colors_of(format) == wire::PixelFormat::rgb16;
  std::vector<float> rgb;
  rgb.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t low = light[2 * i], high = light[2 * i + 1];
    const float covered = alpha ? light_of_half(high >> 16) : 1;
    const float times = covered > 0 ? exposure / covered : 0;
    for (const std::uint32_t half : {low & 0xffff, low >> 16, high & 0xffff})
      rgb.push_back(light_of_half(half) * times);
  }
  view.show(rgb);
  std::vector<std::uint32_t> pixels;
  pixels.reserve(count * wire::pixel_words(format));
  const std::uint32_t most = wide ? 0xffff : 0xff, bits = wide ? 16 : 8;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t covered = alpha ? level_of(light_of_half(light[2 * i + 1] >> 16), most) : 0;
    std::uint64_t pixel = std::uint64_t{covered} << 3 * bits;
    for (std::size_t c = 0; c < 3 && (covered > 0 || !alpha); ++c)
      pixel |= std::uint64_t{level_of(rgb[3 * i + c], most)} << c * bits;
    pixels.push_back(static_cast<std::uint32_t>(pixel));
    if (wide) pixels.push_back(static_cast<std::uint32_t>(pixel >> 32));
  }
  return pixels;
}

}  // namespace mars::images
