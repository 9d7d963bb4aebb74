// glTF 2.0's metallic-roughness material (its specification's appendix B): a matt surface under a clear one that
// reflects 4% straight on, or metal, which reflects its colour; facets with the distribution GGX, Smith's shadowing,
// Schlick's approximation of Fresnel's formula. The appendix takes a facet's being hidden from the eye and from the
// light as independent; here both depend on its height, as is true (E. Heitz, "Understanding the masking-shadowing
// function in microfacet-based BRDFs", JCGT 3, 2014). Lights are scaled by pi, as for all models here.
#pragma once

#include "node/shading/environment.h"
#include "node/shading/kernels/arithmetic.h"
#include "node/shading/kernels/cosines.h"
#include "node/shading/kernels/materials.h"

namespace mars::shading::MARS_SET {

struct MetallicRoughness {
  static constexpr float kLeastRoughness = 0.08f;  // smoother ones have highlights that lie between samples
  static constexpr float kStraightOn = 0.04f;

  Floats diffuse[3], straight[3];  // straight: what is reflected where V.H is 1
  Floats ambient[3];               // how much of light from all around
  Floats unit;
  Floats alpha2;  // (roughness^2)^2
  Floats rough;

  MetallicRoughness(const wire::Material& m, const Scale& scale) : unit(constant(scale.unit)) {
    for (std::size_t c = 0; c < 3; ++c) {
      diffuse[c] = constant(m.color[c] * (1.0f - m.metallic));
      straight[c] = constant(kStraightOn + m.metallic * (m.color[c] - kStraightOn));
      ambient[c] = constant(m.ambient * scale.ambient[c]);
    }
    const float least = m.roughness > kLeastRoughness ? m.roughness : kLeastRoughness;
    const float alpha = least * least;
    alpha2 = constant(alpha * alpha);
    rough = constant(least);
  }
  void change(hn::Mask<FloatTag> mask, const MetallicRoughness& other) {
    MARS_SET::change(mask, other.diffuse, diffuse);
    MARS_SET::change(mask, other.straight, straight);
    MARS_SET::change(mask, other.ambient, ambient);
    alpha2 = hn::IfThenElse(mask, other.alpha2, alpha2);
    rough = hn::IfThenElse(mask, other.rough, rough);
  }

  // pi x reflectance x N.L: ((1 - F) diffuse + F pi D V) N.L.
  void reflect(const Cosines& c, Floats* out) const {
    const Floats one = constant(1.0f);
    const Floats grazing = fifth_power(hn::Sub(one, c.vh));
    const Floats facets = hn::Mul(distribution(c.nh), visibility(c));
    for (int k = 0; k < 3; ++k) {
      const Floats fresnel = hn::Add(straight[k], hn::Mul(hn::Sub(one, straight[k]), grazing));
      const Floats inside = hn::Mul(hn::Sub(one, fresnel), diffuse[k]);
      out[k] = hn::Mul(hn::Mul(unit, c.nl), hn::Add(inside, hn::Mul(fresnel, facets)));
    }
  }

 private:
  // pi D = alpha^2 / ((N.H)^2 (alpha^2 - 1) + 1)^2.
  Floats distribution(Floats nh) const {
    const Floats one = constant(1.0f);
    const Floats below = hn::Add(hn::Mul(hn::Mul(nh, nh), hn::Sub(alpha2, one)), one);
    return hn::Div(alpha2, hn::Mul(below, below));
  }
  // G / (4 (N.L) (N.V)).
  Floats visibility(const Cosines& c) const {
    const Floats rest = hn::Sub(constant(1.0f), alpha2);
    const auto slope = [&](Floats cosine) { return hn::Sqrt(hn::Add(hn::Mul(hn::Mul(cosine, cosine), rest), alpha2)); };
    const Floats sum = hn::Add(hn::Mul(c.nl, slope(c.nv)), hn::Mul(c.nv, slope(c.nl)));
    return hn::Div(constant(0.5f), sum);
  }
};

}  // namespace mars::shading::MARS_SET
