// Cook's and Torrance's model ("A reflectance model for computer graphics", 1982): diffuse N.L, and a white highlight
// F D G / (4 (N.L) (N.V)) of facets with Beckmann's distribution. The paper writes pi instead of 4, with a distribution
// that is not normalised over the hemisphere; with this one surfaces never reflect more than they get (B. Walter et
// al., "Microfacet models for refraction through rough surfaces", 2007). Lights are scaled by pi, as for all models
// here.
#pragma once

#include "node/shading/kernels/arithmetic.h"
#include "node/shading/kernels/cosines.h"
#include "node/shading/kernels/phong.h"

namespace mars::shading::MARS_SET {

struct CookTorrance {
  static constexpr float kLeastRoughness = 0.03f;  // smoother ones have highlights that lie between samples

  Floats ambient[3], diffuse[3], specular;
  Floats inverse_mm;  // 1 / m^2, m the facets' root mean square slope
  Floats index;       // of refraction, squared, less 1

  CookTorrance(const wire::Material& m, const Scale& scale) : specular(constant(scale.unit * m.specular)) {
    const HighlightLanes common(m, scale);
    for (int c = 0; c < 3; ++c) {
      ambient[c] = common.ambient[c];
      diffuse[c] = common.diffuse[c];
    }
    const float rough = m.roughness > kLeastRoughness ? m.roughness : kLeastRoughness;
    inverse_mm = constant(1.0f / (rough * rough));
    index = constant(m.refraction * m.refraction - 1.0f);
  }
  void change(hn::Mask<FloatTag> mask, const CookTorrance& other) {
    MARS_SET::change(mask, other.ambient, ambient);
    MARS_SET::change(mask, other.diffuse, diffuse);
    specular = hn::IfThenElse(mask, other.specular, specular);
    inverse_mm = hn::IfThenElse(mask, other.inverse_mm, inverse_mm);
    index = hn::IfThenElse(mask, other.index, index);
  }

  // pi x reflectance x N.L.
  void reflect(const Cosines& c, Floats* out) const {
    const Floats white = hn::Mul(specular, hn::Mul(hn::Mul(fresnel(c.vh), distribution(c.nh)), attenuation(c)));
    for (int k = 0; k < 3; ++k) out[k] = hn::Add(hn::Mul(diffuse[k], c.nl), white);
  }

 private:
  // pi D = e^(-tan^2 / m^2) / (m^2 cos^4), of the angle between N and H.
  Floats distribution(Floats nh) const {
    const Floats one = constant(1.0f), square = hn::Mul(nh, nh);
    const Floats tangent = hn::Div(hn::Sub(one, square), square);
    const Floats power = exp_of_minus(hn::Mul(tangent, inverse_mm));
    return hn::Mul(hn::Div(power, hn::Mul(square, square)), inverse_mm);
  }
  // G / (4 N.V), G the least of 1, 2 (N.H)(N.V) / V.H and 2 (N.H)(N.L) / V.H: facets hide each other.
  static Floats attenuation(const Cosines& c) {
    const Floats one = constant(1.0f);
    const Floats groove = hn::Div(hn::Add(c.nh, c.nh), c.vh);
    const Floats light = hn::Div(hn::Min(one, hn::Mul(groove, c.nl)), c.nv);
    return hn::Mul(hn::Min(light, groove), constant(0.25f));
  }
  // F of unpolarised light, from c = V.H and g^2 = index^2 - 1 + c^2.
  Floats fresnel(Floats c) const {
    const Floats one = constant(1.0f);
    const Floats g = hn::Sqrt(hn::Add(index, hn::Mul(c, c)));
    const Floats sum = hn::Add(g, c), difference = hn::Sub(g, c);
    const Floats first = hn::Div(difference, sum);
    const Floats second = hn::Div(hn::Sub(hn::Mul(c, sum), one), hn::Add(hn::Mul(c, difference), one));
    return hn::Mul(hn::Mul(hn::Mul(first, first), constant(0.5f)), hn::Add(one, hn::Mul(second, second)));
  }
};

}  // namespace mars::shading::MARS_SET
