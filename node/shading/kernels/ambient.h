// Light from all around: wire::AmbientLight.
#pragma once

#include "node/shading/kernels/cook_torrance.h"
#include "node/shading/kernels/incidence.h"
#include "node/shading/kernels/metallic_roughness.h"

namespace mars::shading::MARS_SET {

// The same from everywhere.
inline bool is_even(const wire::AmbientLight& ambient) {
  bool even = true;
  for (std::size_t c = 0; c < 3; ++c) even &= ambient.sky[c] == ambient.ground[c];
  return even;
}

// By direction; 1 where it is even, which Scale has taken in.
class Hemisphere {
 public:
  explicit Hemisphere(const Shading& shading) {
    const bool even = is_even(shading.ambient);
    for (std::size_t c = 0; c < 3; ++c) {
      ground_[c] = constant(even ? 1.0f : shading.ambient.ground[c]);
      more_[c] = constant(even ? 0.0f : shading.ambient.sky[c] - shading.ambient.ground[c]);
      up_[c] = constant(shading.up[c]);
    }
  }

  // The cosines' mean over the hemisphere round the normal: evenly from ground to sky by the normal's z.
  void around_normal(const Surfaces& s, Floats* light) const { mix(hn::Mul(dot(s.n, up_), s.inverse_n), light); }

  // About the direction in which the eye's is mirrored, blurred as the surface is rough: as round a normal there if it
  // is fully rough, the smoother, the sharper is the horizon.
  void mirrored(const Surfaces& s, Floats rough, Floats* light) const {
    const Floats nz = hn::Mul(dot(s.n, up_), s.inverse_n), ne = hn::Mul(s.ne, s.inverse_n);
    const Floats product = hn::Mul(nz, ne);
    const Floats z = hn::Mul(hn::Sub(hn::Add(product, product), dot(s.e, up_)), s.inverse_e());
    mix(hn::Div(z, rough), light);
  }

 private:
  void mix(Floats z, Floats* light) const {
    const Floats half = constant(0.5f), share = between_0_and_1(hn::Add(half, hn::Mul(half, z)));
    for (int c = 0; c < 3; ++c) light[c] = hn::Add(ground_[c], hn::Mul(more_[c], share));
  }

  Floats ground_[3], more_[3], up_[3];
};

// What surfaces reflect of it.
template <typename Lanes>
void reflect_ambient(const Hemisphere& hemisphere, const Surfaces& s, const Lanes& lanes, Floats* color) {
  Floats light[3];
  hemisphere.around_normal(s, light);
  for (int c = 0; c < 3; ++c) color[c] = hn::Mul(lanes.ambient[c], light[c]);
}

// A share of EnvironmentTable, between its four numbers round N.V and the roughness, both 0..1.
inline Floats look_up(const float* table, Floats nv, Floats rough) {
  constexpr int kSide = EnvironmentTable::kSide;
  const Floats most = constant(kSide - 1), last = constant(kSide - 2);
  const Floats x = hn::Mul(nv, most), y = hn::Mul(rough, most);
  const Floats column = hn::Min(hn::Floor(x), last), row = hn::Min(hn::Floor(y), last);
  const Floats dx = hn::Sub(x, column), dy = hn::Sub(y, row);
  const Ints at = hn::ConvertTo(kInts, hn::Add(hn::Mul(row, constant(kSide)), column));
  const auto along = [&](const float* two) {
    const Floats first = hn::GatherIndex(kFloats, two, at), second = hn::GatherIndex(kFloats, two + 1, at);
    return hn::Add(first, hn::Mul(dx, hn::Sub(second, first)));
  };
  const Floats upper = along(table), lower = along(table + kSide);
  return hn::Add(upper, hn::Mul(dy, hn::Sub(lower, upper)));
}

// Metal is lit by what it mirrors; what a clear surface mirrors does not reach the matt one under it.
template <>
inline void reflect_ambient(const Hemisphere& hemisphere, const Surfaces& s, const MetallicRoughness& lanes,
                            Floats* color) {
  const EnvironmentTable& table = environment_table();
  const Floats nv = between_0_and_1(hn::Mul(hn::Mul(s.ne, s.inverse_n), s.inverse_e()));
  const Floats colored = look_up(table.colored, nv, lanes.rough), white = look_up(table.white, nv, lanes.rough);
  Floats around[3], mirrored[3];
  hemisphere.around_normal(s, around);
  hemisphere.mirrored(s, lanes.rough, mirrored);
  for (int c = 0; c < 3; ++c) {
    const Floats share = hn::Add(hn::Mul(lanes.straight[c], colored), white);
    const Floats inside = hn::Mul(hn::Mul(hn::Sub(constant(1.0f), share), lanes.diffuse[c]), around[c]);
    color[c] = hn::Mul(hn::Mul(lanes.unit, lanes.ambient[c]), hn::Add(inside, hn::Mul(share, mirrored[c])));
  }
}

}  // namespace mars::shading::MARS_SET
