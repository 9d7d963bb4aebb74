// Fog by depth: wire::Fog.
#pragma once

#include "node/shading/kernels/incidence.h"

namespace mars::shading::MARS_SET {

inline bool is_foggy(const wire::Fog& fog) { return fog.end > fog.start; }

// Mixes fog into the block's colours, in which 1 is `unit`.
inline void add_fog(const wire::Fog& fog, float unit, Block& block) {
  constexpr float kSharpest = 1e30f;
  const float rise = 1.0f / (fog.end - fog.start);
  const Floats start = constant(fog.start), per_distance = constant(rise < kSharpest ? rise : kSharpest);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    Floats inverse_w, rest[3];
    hn::LoadInterleaved4(kFloats, block.values[k], inverse_w, rest[0], rest[1], rest[2]);
    const Floats w = hn::Div(constant(1.0f), inverse_w);
    const Floats share = between_0_and_1(hn::Mul(hn::Sub(w, start), per_distance));
    for (std::size_t c = 0; c < 3; ++c) {
      const Floats color = hn::Load(kFloats, block.color[c] + k);
      const Floats more = hn::Sub(constant(unit * fog.color[c]), color);
      hn::Store(hn::Add(color, hn::Mul(share, more)), kFloats, block.color[c] + k);
    }
  }
}

}  // namespace mars::shading::MARS_SET
