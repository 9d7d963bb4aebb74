// Blinn's highlight (J. F. Blinn, "Models of light reflection for computer synthesized pictures", 1977): as Phong's,
// but white (N.H)^exponent, H halfway between the directions to the eye and to the light.
#pragma once

#include "node/shading/kernels/phong.h"

namespace mars::shading::MARS_SET {

struct BlinnPhong {
  // (N.H)^2: H = e / |e| + t / |t| has the squared length 2 + 2 (e.t) / (|e| |t|).
  static Floats square(const Surfaces& s, const Rays& r) {
    const Floats inverse_e = hn::Sqrt(s.inverse_ee), inverse_t = r.inverse_t();
    const Floats nh = hn::Add(hn::Mul(s.ne, inverse_e), hn::Mul(r.nt, inverse_t));
    const Floats te = hn::Mul(hn::Mul(r.te, inverse_e), inverse_t);
    const Floats hh = hn::Max(hn::Add(constant(2.0f), hn::Add(te, te)), constant(1e-6f));
    const Floats cosine = hn::Mul(nh, s.inverse_n);
    const Floats square = hn::Min(hn::Div(hn::Mul(cosine, cosine), hh), constant(1.0f));
    return hn::IfThenElseZero(hn::And(r.front, hn::Gt(nh, zero())), square);
  }
};

}  // namespace mars::shading::MARS_SET
