// Which triangles may block points from anywhere in a light.
#include <cstdint>

#include "node/shadow/kernels/functions.h"

namespace mars::shadow::MARS_SET {

namespace {

constexpr float kGridRounding = 2;    // steps by which places of two views differ, beside the spread
constexpr float kFloatRounding = 64;  // steps that a float of a place on the grid may be off
constexpr std::int32_t kSmooth = 8;   // steps that a triangle is high, at least, for its slope to be near the surface's

// Widened by the shafts' width at a caster's height over a vector's lowest point.
struct WideBox {
  Floats low_x, high_x, low_y, high_y, low_z, spread;

  WideBox(const GridBox& box, float to_side)
      : low_x(constant(static_cast<float>(box.low_x))),
        high_x(constant(static_cast<float>(box.high_x))),
        low_y(constant(static_cast<float>(box.low_y))),
        high_y(constant(static_cast<float>(box.high_y))),
        low_z(constant(box.low_z)),
        spread(constant(to_side)) {}

  // Bits of the lanes from k on of boxes that meet it.
  template <typename Boxes>
  hn::Mask<FloatTag> meets(const Boxes& b, std::uint32_t k) const {
    const auto place = [k](const std::int32_t* all) { return hn::ConvertTo(kFloats, hn::Load(kInts, all + k)); };
    const Floats height = hn::Sub(hn::Load(kFloats, b.high_z + k), low_z);
    const Floats margin = hn::Add(hn::Mul(height, spread), constant(kFloatRounding));
    const auto x =
        hn::And(hn::Le(hn::Sub(place(b.low_x), margin), high_x), hn::Ge(hn::Add(place(b.high_x), margin), low_x));
    const auto y =
        hn::And(hn::Le(hn::Sub(place(b.low_y), margin), high_y), hn::Ge(hn::Add(place(b.high_y), margin), low_y));
    return hn::And(hn::And(x, y), hn::Gt(height, constant(0.0f)));
  }
};

std::uint32_t meeting(const SmallBatches& b, std::uint32_t first, const WideBox& box) {
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) found |= bits(kFloats, box.meets(b, first + k)) << k;
  return found;
}

// Of triangles that meet the box, those that reach before the plane near the points, where its rise is small.
std::uint32_t meeting(const SmallTriangles& t, const WideBox& box, const PointVector& points, const Shaft& shaft) {
  const float tilt = magnitude(points.per_x) + magnitude(points.per_y);
  const bool is_flat = shaft.spread * tilt <= kMostRise;
  const Floats limit = constant(points.least + room(points, shaft));
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    auto here = box.meets(t, k);
    if (hn::AllFalse(kFloats, here)) continue;
    if (is_flat) here = hn::And(here, hn::Gt(highest_before(t, k, points), limit));
    found |= bits(kFloats, here) << k;
  }
  return found;
}

// Twice its area over its longest side's length, about.
bool is_smooth(const SmallTriangles& t, std::uint32_t n) {
  const std::int32_t x1 = t.x[1][n] - t.x[0][n], y1 = t.y[1][n] - t.y[0][n];
  const std::int32_t x2 = t.x[2][n] - t.x[0][n], y2 = t.y[2][n] - t.y[0][n];
  const std::int32_t wide = t.high_x[n] - t.low_x[n], high = t.high_y[n] - t.low_y[n];
  return x1 * y2 - x2 * y1 >= kSmooth * (wide > high ? wide : high);
}

// Whether shafts of open points meet a triangle. A triangle that rises less than a shaft's rays is nowhere before a
// point if its plane is not, by so much of the bound (point_vector.h) as views of other points of the light leave.
bool meets(const SmallTriangles& t, std::uint32_t n, const PointVector& points, const Shaft& shaft) {
  const float rise = shaft.tangent * t.slope[n];
  const bool is_bounded = rise <= kMostRise && is_smooth(t, n);
  const Floats low_x = constant(-kGridRounding), low_y = low_x;
  const Floats wide = constant(static_cast<float>(t.high_x[n] - t.low_x[n]) + kGridRounding);
  const Floats high = constant(static_cast<float>(t.high_y[n] - t.low_y[n]) + kGridRounding);
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const std::uint32_t open = (points.active & ~points.blocked) >> k;
    const std::uint8_t asked[8] = {static_cast<std::uint8_t>(open), static_cast<std::uint8_t>(open >> 8)};
    const Ints x = hn::Load(kInts, points.x + k), y = hn::Load(kInts, points.y + k);
    const Floats z = hn::Load(kFloats, points.z + k);
    const Floats height = hn::Sub(constant(t.high_z[n]), z);
    const Floats margin = hn::Mul(height, constant(shaft.spread));
    const Floats from_x = hn::ConvertTo(kFloats, hn::Sub(x, hn::Set(kInts, t.low_x[n])));
    const Floats from_y = hn::ConvertTo(kFloats, hn::Sub(y, hn::Set(kInts, t.low_y[n])));
    auto here = hn::And(hn::LoadMaskBits(kFloats, asked), hn::Gt(height, constant(0.0f)));
    here = hn::And(here, hn::And(hn::Ge(hn::Add(from_x, margin), low_x), hn::Le(hn::Sub(from_x, margin), wide)));
    here = hn::And(here, hn::And(hn::Ge(hn::Add(from_y, margin), low_y), hn::Le(hn::Sub(from_y, margin), high)));
    if (hn::AllFalse(kFloats, here)) continue;
    if (is_bounded) {
      const Floats dx = hn::ConvertTo(kFloats, hn::Sub(x, hn::Set(kInts, t.x[0][n])));
      const Floats dy = hn::ConvertTo(kFloats, hn::Sub(y, hn::Set(kInts, t.y[0][n])));
      const Floats there =
          hn::Add(hn::Add(constant(t.z[0][n]), hn::Mul(dy, constant(t.per_y[n]))), hn::Mul(dx, constant(t.per_x[n])));
      const Floats error = hn::Load(kFloats, points.error + k), size = shaft.has_place ? z : constant(1.0f);
      const Floats level = hn::Mul(hn::Mul(error, size), constant(1 - rise));
      const Floats sloping =
          hn::Mul(hn::Max(hn::Sub(error, constant(shaft.rounding)), hn::Zero(kFloats)), constant(t.slope[n]));
      const Floats bound = shaft.has_place ? level : hn::Add(level, sloping);
      here = hn::And(here, hn::Gt(hn::Sub(there, z), hn::Mul(bound, constant(shaft.bound))));
      if (hn::AllFalse(kFloats, here)) continue;
    }
    for (int e = 0; e < 3; ++e) {
      const int to = e == 2 ? 0 : e + 1;
      const float ex = static_cast<float>(t.x[to][n] - t.x[e][n]), ey = static_cast<float>(t.y[to][n] - t.y[e][n]);
      const Floats dx = hn::ConvertTo(kFloats, hn::Sub(x, hn::Set(kInts, t.x[e][n])));
      const Floats dy = hn::ConvertTo(kFloats, hn::Sub(y, hn::Set(kInts, t.y[e][n])));
      const Floats function = hn::Sub(hn::Mul(constant(ex), dy), hn::Mul(constant(ey), dx));
      const Floats reach = hn::Mul(hn::Add(margin, constant(kGridRounding)), constant(magnitude(ex) + magnitude(ey)));
      here = hn::And(here, hn::Ge(hn::Add(function, reach), hn::Zero(kFloats)));
    }
    if (!hn::AllFalse(kFloats, here)) return true;
  }
  return false;
}

bool meets_any(const SmallTriangles& t, std::uint32_t some, const PointVector& points, const Shaft& shaft) {
  for (; some != 0; some &= some - 1)
    if (meets(t, static_cast<std::uint32_t>(__builtin_ctz(some)), points, shaft)) return true;
  return false;
}

}  // namespace

void touch(const SmallBatches& batches, const Shaft& shaft, const PointVector* points, const std::uint32_t* found,
           std::uint32_t found_count, std::uint64_t& touching, std::uint8_t* touched) {
  for (const std::uint32_t* at = found; at != found + found_count; ++at) {
    const PointVector& here = points[*at];
    const WideBox box(here.box, shaft.spread);
    for (std::uint32_t first = 0; first < batches.count; first += kPointLanes) {
      const std::uint32_t rest = batches.count - first, all = rest < kPointLanes ? (1u << rest) - 1 : 0xffffu;
      std::uint32_t some = meeting(batches, first, box) & all;
      for (; some != 0; some &= some - 1) {
        const std::uint32_t number = first + static_cast<std::uint32_t>(__builtin_ctz(some));
        const std::uint64_t bit = std::uint64_t{1} << number;
        if ((touching & bit) != 0 && touched[*at] != 0) continue;
        const SmallTriangles& batch = batches.batch[number];
        if (!meets_any(batch, meeting(batch, box, here, shaft), here, shaft)) continue;
        touching |= bit;
        touched[*at] = 1;
      }
    }
  }
}

}  // namespace mars::shadow::MARS_SET
