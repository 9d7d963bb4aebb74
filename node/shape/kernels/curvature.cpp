// How a patch bends, as it is seen, at sixteen places.
#include "node/shape/kernels/functions.h"

namespace mars::shape::MARS_SET {

using namespace simd::MARS_SET;

namespace {

struct Vector {
  Floats x, y, z;
};

Floats dot(const Vector& a, const Vector& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

Vector cross(const Vector& a, const Vector& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

Vector blend(const float (*weight)[16], int place, const float (*points)[3]) {
  Vector sum{hn::Zero(kFloats), hn::Zero(kFloats), hn::Zero(kFloats)};
  for (int i = 0; i < 16; ++i) {
    const Floats w = hn::Load(kFloats, weight[i] + place);
    sum.x = hn::Add(sum.x, hn::Mul(w, constant(points[i][0])));
    sum.y = hn::Add(sum.y, hn::Mul(w, constant(points[i][1])));
    sum.z = hn::Add(sum.z, hn::Mul(w, constant(points[i][2])));
  }
  return sum;
}

// a / b, 0 where b is.
Floats ratio(Floats a, Floats b) { return hn::IfThenElseZero(hn::Gt(b, hn::Zero(kFloats)), hn::Div(a, b)); }

}  // namespace

Fineness estimate_curvature(const CurvatureWeights& weights, const float (*points)[3], const Projection& projection,
                            const Tolerances& tolerances) {
  const float finest = projection.squeeze > 1 ? projection.scale * projection.squeeze : projection.scale;
  Floats most_u = hn::Zero(kFloats), most_v = hn::Zero(kFloats);
  for (int place = 0; place < 16; place += kLanes) {
    const auto at = [&](CurvatureWeights::Kind kind) { return blend(weights.weight[kind], place, points); };
    const Vector p = at(CurvatureWeights::kPlace), u = at(CurvatureWeights::kU), v = at(CurvatureWeights::kV);
    const Vector n = cross(u, v);
    const Floats unit = ratio(constant(1), hn::Sqrt(dot(n, n)));
    const auto bend = [&](CurvatureWeights::Kind kind) { return hn::Mul(hn::Abs(dot(n, at(kind))), unit); };
    const Floats uu = bend(CurvatureWeights::kUU), uv = bend(CurvatureWeights::kUV), vv = bend(CurvatureWeights::kVV);
    const Floats length_u = hn::Sqrt(dot(u, u)), length_v = hn::Sqrt(dot(v, v));

    // From a place to the eye, but for its sign.
    const Vector ray = projection.parallel ? Vector{hn::Zero(kFloats), hn::Zero(kFloats), constant(1)} : p;
    const Floats toward = hn::Mul(dot(n, ray), unit);
    const Floats cosine2 = ratio(hn::Mul(toward, toward), dot(ray, ray));
    const Floats sine = hn::Sqrt(hn::Max(hn::Sub(constant(1), cosine2), hn::Zero(kFloats)));
    const Floats depth = projection.parallel ? constant(1) : hn::Max(hn::Neg(p.z), constant(projection.near));
    const Floats pixels = hn::Div(constant(finest), depth);
    const Floats shown = hn::Mul(hn::Mul(sine, pixels), constant(1 / (8 * tolerances.outline)));
    const auto fineness = [&](Floats own, Floats length, Floats other_length) {
      const Floats outline = hn::Sqrt(hn::Mul(hn::Add(own, uv), shown));
      const Floats turns = hn::Add(ratio(own, length), ratio(uv, other_length));
      const Floats shade = hn::Min(hn::Mul(turns, constant(1 / tolerances.turn)),
                                   hn::Mul(hn::Mul(length, pixels), constant(1 / tolerances.least_step)));
      return hn::Max(outline, shade);
    };
    most_u = hn::Max(most_u, fineness(uu, length_u, length_v));
    most_v = hn::Max(most_v, fineness(vv, length_v, length_u));
  }
  return {hn::GetLane(hn::MaxOfLanes(kFloats, most_u)), hn::GetLane(hn::MaxOfLanes(kFloats, most_v))};
}

}  // namespace mars::shape::MARS_SET
