// Phong's model (B. T. Phong, "Illumination for computer generated pictures", 1975): diffuse N.L, white highlight
// (R.V)^exponent.
#pragma once

#include "node/shading/kernels/arithmetic.h"
#include "node/shading/kernels/incidence.h"
#include "node/shading/kernels/materials.h"

namespace mars::shading::MARS_SET {

// Phong's and Blinn's materials.
struct HighlightLanes {
  Floats ambient[3], diffuse[3], specular;

  HighlightLanes(const wire::Material& m, const Scale& scale) : specular(constant(scale.unit * m.specular)) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float own = scale.unit * m.color[c];
      ambient[c] = constant(m.ambient * own * scale.ambient[c]);
      diffuse[c] = constant(m.diffuse * own);
    }
  }
  void change(hn::Mask<FloatTag> mask, const HighlightLanes& other) {
    MARS_SET::change(mask, other.ambient, ambient);
    MARS_SET::change(mask, other.diffuse, diffuse);
    specular = hn::IfThenElse(mask, other.specular, specular);
  }
};

struct Phong {
  // (R.V)^2, where R.V = (2 (n.t)(n.e) - (t.e)(n.n)) / ((n.n) |t| |e|). Its square is what is raised to half the
  // exponent, so |e| is never taken.
  static Floats square(const Surfaces& s, const Rays& r) {
    const Floats reflected = hn::Sub(hn::Mul(hn::Add(r.nt, r.nt), s.ne), hn::Mul(r.te, s.nn));
    const Floats mirrored = hn::Mul(hn::Mul(reflected, r.inverse_nt), s.inverse_n);
    const Floats square = hn::Min(hn::Mul(hn::Mul(mirrored, mirrored), s.inverse_ee), constant(1.0f));
    return hn::IfThenElseZero(hn::And(r.front, hn::Gt(mirrored, zero())), square);
  }
};

}  // namespace mars::shading::MARS_SET
