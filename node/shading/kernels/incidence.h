// Where a vector of samples lies between the eye and one light. Directions are not normalised before they are used:
// with n the normal / w, e that to the eye and t that to the light, a product of two is divided by both their lengths.
// In parallel projection w is 1 (Block::place_parallel).
#pragma once

#include "node/shading/kernels/block.h"

namespace mars::shading::MARS_SET {

// A vector of a block's samples.
struct Surfaces {
  Floats n[3], e[3], inverse_w;
  Floats from[3];  // Block::from
  Floats nn, ee, ne;
  Floats inverse_n;   // 1 / |n|; 0 where there is no normal
  Floats inverse_ee;  // 1 / |e|^2; NaN where there is no normal

  // One root and one division do for n and e.
  Surfaces(const Block& block, std::uint32_t k) {
    hn::LoadInterleaved4(kFloats, block.values[k], inverse_w, n[0], n[1], n[2]);
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = hn::Load(kFloats, block.from[axis] + k);
      e[axis] = !block.parallel ? from[axis] : axis == 2 ? constant(1.0f) : zero();
    }
    nn = dot(n, n), ee = dot(e, e), ne = dot(n, e);
    const Floats length = hn::Sqrt(nn);
    const Floats inverse = hn::Div(constant(1.0f), hn::Mul(length, ee));
    inverse_n = hn::IfThenElseZero(hn::Gt(nn, zero()), hn::Mul(inverse, ee));
    inverse_ee = hn::Mul(inverse, length);
  }

  Floats inverse_e() const { return hn::Div(constant(1.0f), hn::Sqrt(ee)); }  // a number everywhere
};

// From a vector of samples to one light.
struct Rays {
  Floats t[3];
  Floats length;      // |t|
  Floats inverse_nt;  // 1 / (|n| |t|); 0 where there is no normal or the light is at the surface
  Floats nt, te;
  hn::Mask<FloatTag> front;  // the light is before the surface

  Floats inverse_t() const { return hn::IfThenElseZero(hn::Gt(length, zero()), hn::Div(constant(1.0f), length)); }
  Floats facing() const { return hn::IfThenElseZero(front, hn::Mul(nt, inverse_nt)); }  // N.L
};

// 0 where not even a comparison holds.
inline Floats between_0_and_1(Floats value) { return hn::Min(hn::Max(value, zero()), constant(1.0f)); }

}  // namespace mars::shading::MARS_SET
