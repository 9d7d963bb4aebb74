#include "host/images/picture_place.h"

#include <cmath>

namespace mars::images {

// The first convergent of the continued fraction that a float does not tell from the number, or the last with small
// terms.
Ratio ratio_of(float pixel_aspect) {
  constexpr double kMost = 1 << 20;
  double rest = pixel_aspect, width = 1, height = 0, last_width = 0, last_height = 1;
  for (;;) {
    const double whole = std::floor(rest);
    const double next_width = whole * width + last_width, next_height = whole * height + last_height;
    if (next_width > kMost || next_height > kMost) break;
    last_width = width, last_height = height;
    width = next_width, height = next_height;
    if (static_cast<float>(width / height) == pixel_aspect || rest == whole) break;
    rest = 1 / (rest - whole);
  }
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

}  // namespace mars::images
