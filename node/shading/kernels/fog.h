// Fog by depth: wire::Fog.
#pragma once

#include "node/shading/kernels/incidence.h"

namespace mars::shading::MARS_SET {

inline bool is_foggy(const wire::Fog& fog) { return fog.end > fog.start; }

class FogDepth {
 public:
  explicit FogDepth(const wire::Fog& fog) : start_(constant(fog.start)) {
    constexpr float kSharpest = 1e30f;
    const float rise = 1.0f / (fog.end - fog.start);
    per_distance_ = constant(rise < kSharpest ? rise : kSharpest);
  }
  // At the sample's distance along the view axis.
  Floats share(const Block& block, std::uint32_t k) const {
    Floats inverse_w, rest[3];
    hn::LoadInterleaved4(kFloats, block.values[k], inverse_w, rest[0], rest[1], rest[2]);
    const Floats distance = hn::Div(hn::Load(kFloats, block.from[2] + k), inverse_w);
    return between_0_and_1(hn::Mul(hn::Sub(distance, start_), per_distance_));
  }

 private:
  Floats start_, per_distance_;
};

// Mixes fog into the block's colours, in which 1 is `unit`.
inline void add_fog(const wire::Fog& fog, float unit, Block& block) {
  const FogDepth depth(fog);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    const Floats share = depth.share(block, k);
    for (std::size_t c = 0; c < 3; ++c) {
      const Floats color = hn::Load(kFloats, block.color[c] + k);
      const Floats more = hn::Sub(constant(unit * fog.color[c]), color);
      hn::Store(hn::Add(color, hn::Mul(share, more)), kFloats, block.color[c] + k);
    }
  }
}

}  // namespace mars::shading::MARS_SET
