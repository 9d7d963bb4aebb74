#include "node/color/encoding.h"

#include <algorithm>

namespace mars::color {

Encoding encoding_of(const wire::FilmSettings& settings, const wire::Camera& camera, wire::PixelFormat format) {
  return {settings.color_space, settings.curve, static_cast<float>(camera.exposure), format};
}

std::uint64_t pixel_of(const Encoding&, const float* light) {
  std::uint64_t pixel = 0;
  for (int c = 0; c < 3; ++c) {
    const float level = std::clamp(light[c], 0.0f, 1.0f) * 255.0f + 0.5f;
    pixel |= static_cast<std::uint64_t>(level) << (8 * c);
  }
  return pixel;
}

}  // namespace mars::color
