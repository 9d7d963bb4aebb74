// The angles that models of rough surfaces are functions of.
#pragma once

#include "node/shading/kernels/incidence.h"

namespace mars::shading::MARS_SET {

// N the normal, L the direction to the light, V that to the eye, H halfway between the latter two. L is before the
// surface; V is taken to be there too: interpolated normals turn away from the eye near outlines.
struct Cosines {
  Floats nl, nv, nh, vh;

  Cosines(const Surfaces& s, const Rays& r) {
    const Floats least = constant(1e-4f), one = constant(1.0f);
    const Floats inverse_e = hn::Sqrt(s.inverse_ee), inverse_t = r.inverse_t();
    const auto limited = [&](Floats cosine) { return hn::Min(hn::Max(cosine, least), one); };
    nl = limited(hn::Mul(r.nt, r.inverse_nt));
    const Floats eye = hn::Mul(hn::Mul(s.ne, s.inverse_n), inverse_e);
    nv = limited(eye);
    const Floats lv = hn::Mul(hn::Mul(r.te, inverse_e), inverse_t);
    const Floats hh = hn::Max(hn::Add(hn::Add(lv, lv), constant(2.0f)), constant(1e-6f));
    const Floats length = hn::Sqrt(hh);
    nh = limited(hn::Div(hn::Add(hn::Mul(r.nt, r.inverse_nt), eye), length));
    vh = limited(hn::Mul(length, constant(0.5f)));  // |V + L| / 2
  }
};

}  // namespace mars::shading::MARS_SET
