// Bones as unit dual quaternions, between which a skin's points turn instead of taking the short cut of a linear blend
// (Kavan, Collins, Zara & O'Sullivan, "Geometric skinning with approximate dual quaternion blending", 2008). A bone's
// matrix is a stretch, then a turn, then a place: of a point's bones, the stretches are blended as matrices, turns and
// places as dual quaternions. Only + - * / and roots: the same bits everywhere.
#pragma once

#include "node/shape/vertices.h"
#include "node/wire/film_parts.h"

namespace mars::shape {

// p' = turn stretch p + place.
struct BoneParts {
  double turn[3][3];  // a rotation
  double stretch[3][3];
  double place[3];
};

// Whether the bone leaves no volume, or nearly none: then its turn is not known. Its axes' lengths do not matter.
bool is_flat(const wire::Matrix& bone);

// `turn` is the rotation nearest to the bone's axes, of a bone that mirrors to their opposites; of a flat one, none.
BoneParts parts_of(const wire::Matrix& bone);

DualBone<double> dual_bone(const BoneParts& parts);
DualBone<float> rounded(const DualBone<double>& bone);

// The sum of a point's bones, each times its weight. It begins with 0, so that a bone without weight changes no bit. A
// quaternion and its opposite are the same turn: of the two, that is added which lies on the side of the sum so far.
template <typename Number>
class DualBlend {
 public:
  void add(const DualBone<Number>& bone, Number weight) {
    const Number along =
        ((real_[0] * bone.real[0] + real_[1] * bone.real[1]) + real_[2] * bone.real[2]) + real_[3] * bone.real[3];
    const Number turned = along < 0 ? -weight : weight;
    for (int i = 0; i < 4; ++i) real_[i] += turned * bone.real[i];
    for (int i = 0; i < 4; ++i) dual_[i] += turned * bone.dual[i];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) stretch_[r][c] += weight * bone.stretch[r][c];
  }

  // By which the point goes: m[r][0..2] . p + m[r][3].
  template <typename Rows>
  void put(Rows& m) const {
    const auto& [w, x, y, z] = real_;
    const auto& [dw, dx, dy, dz] = dual_;
    const Number two = Number{2} / (((w * w + x * x) + y * y) + z * z);
    const Number x2 = x * two, y2 = y * two, z2 = z * two;
    const Number turn[3][3] = {{Number{1} - (y * y2 + z * z2), x * y2 - w * z2, x * z2 + w * y2},
                               {x * y2 + w * z2, Number{1} - (x * x2 + z * z2), y * z2 - w * x2},
                               {x * z2 - w * y2, y * z2 + w * x2, Number{1} - (x * x2 + y * y2)}};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        m[r][c] = (turn[r][0] * stretch_[0][c] + turn[r][1] * stretch_[1][c]) + turn[r][2] * stretch_[2][c];
    m[0][3] = ((w * dx - dw * x) + (y * dz - z * dy)) * two;
    m[1][3] = ((w * dy - dw * y) + (z * dx - x * dz)) * two;
    m[2][3] = ((w * dz - dw * z) + (x * dy - y * dx)) * two;
  }

 private:
  Number real_[4] = {}, dual_[4] = {}, stretch_[3][3] = {};
};

}  // namespace mars::shape
