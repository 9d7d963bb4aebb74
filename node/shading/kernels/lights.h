// The kinds of light: where each comes from and how bright it is at a sample.
#pragma once

#include "node/shading/kernels/incidence.h"

namespace mars::shading::MARS_SET {

class Light {
 public:
  explicit Light(const geometry::EyeLight& light)
      : has_place_(light.kind != wire::LightKind::directional),
        is_spot_(light.kind == wire::LightKind::spot),
        reach_(has_place_ ? light.reach : 0),
        cos_outer_(light.cos_outer) {
    constexpr float kSharpest = 1e-6f;
    const float width = light.cos_inner - light.cos_outer;
    per_cone_ = 1.0f / (width > kSharpest ? width : kSharpest);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      vector_[axis] = constant(light.vector[axis]);
      against_axis_[axis] = constant(-light.axis[axis]);
      color_[axis] = constant(light.color[axis]);
    }
  }

  // Whether it is not equally bright everywhere.
  bool fades() const { return is_spot_ || reach_ > 0; }
  const Floats* color() const { return color_; }

  Rays rays(const Surfaces& s) const {
    Rays r;
    for (int axis = 0; axis < 3; ++axis) r.t[axis] = vector_[axis];
    r.inverse_nt = s.inverse_n;
    r.length = constant(1.0f);
    if (has_place_) {
      // The sample's place is -from * w; the length of t does not matter.
      for (int axis = 0; axis < 3; ++axis) r.t[axis] = hn::Add(hn::Mul(vector_[axis], s.inverse_w), s.from[axis]);
      const Floats square = dot(r.t, r.t);
      r.length = hn::Sqrt(square);
      r.inverse_nt = hn::IfThenElseZero(hn::Gt(square, zero()), hn::Div(s.inverse_n, r.length));
    }
    r.nt = dot(s.n, r.t), r.te = dot(r.t, s.e);
    r.front = hn::Gt(r.nt, zero());
    return r;
  }

  // 0..1 of its colour. A light with a reach is 1 / (1 + (distance / reach)^2), which stays finite at the light; a
  // spot's edge is 3 x^2 - 2 x^3 of the cosine's way from the outer cone to the inner one (glTF's KHR_lights_punctual
  // has x^2 there, which breaks at the inner cone).
  Floats brightness(const Surfaces& s, const Rays& r) const {
    Floats bright = constant(1.0f);
    if (reach_ > 0) {
      const Floats reach = hn::Max(hn::Mul(s.inverse_w, constant(reach_)), constant(1e-30f));
      const Floats ratio = hn::Min(hn::Div(r.length, reach), constant(1e15f));
      bright = hn::Div(bright, hn::Add(bright, hn::Mul(ratio, ratio)));
    }
    if (is_spot_) {
      const Floats cosine = hn::Mul(dot(against_axis_, r.t), r.inverse_t());
      const Floats x = between_0_and_1(hn::Mul(hn::Sub(cosine, constant(cos_outer_)), constant(per_cone_)));
      const Floats smooth = hn::Mul(hn::Mul(x, x), hn::Sub(constant(3.0f), hn::Add(x, x)));
      bright = hn::Mul(bright, smooth);
    }
    return bright;
  }

 private:
  bool has_place_, is_spot_;
  float reach_, cos_outer_, per_cone_;
  Floats vector_[3], against_axis_[3], color_[3];
};

}  // namespace mars::shading::MARS_SET
