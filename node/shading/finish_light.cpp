#include "node/shading/finish_light.h"

#include <cstddef>

namespace mars::shading {

void finish_light(const Shading& shading, float share, float (&light)[3]) {
  const float most = shading.encoding.space == wire::ColorSpace::coded ? 1.0f : kMostShaded;
  const bool foggy = shading.fog.end > shading.fog.start;
  for (std::size_t c = 0; c < 3; ++c) {
    if (foggy) light[c] += share * (shading.fog.color[c] - light[c]);
    const float bright = light[c] > 0 ? light[c] : 0;
    light[c] = bright < most ? bright : most;
  }
}

}  // namespace mars::shading
