// Which points casters block.
#include <cstddef>
#include <cstdint>

#include "node/shadow/kernels/functions.h"

namespace mars::shadow::MARS_SET {

namespace {

constexpr std::ptrdiff_t kAhead = 2;  // vectors of points that are fetched

// Corner `number` of a batch's triangles from lane k on.
struct Corner {
  Ints x, y;
  Floats z;

  Corner(const GridVertices& v, const std::uint32_t* numbers, std::uint32_t k) {
    const Ints at = hn::LoadU(kInts, reinterpret_cast<const std::int32_t*>(numbers) + k);
    x = hn::GatherIndex(kInts, v.x, at);
    y = hn::GatherIndex(kInts, v.y, at);
    z = hn::GatherIndex(kFloats, v.z, at);
  }
};

// The least value of an edge's function inside: points on an edge belong to the triangle on one side of it.
Ints least_inside(Ints dx, Ints dy) {
  const Ints none = hn::Zero(kInts), one = hn::Set(kInts, 1);
  const auto has_edge = hn::Or(hn::Gt(dy, none), hn::And(hn::Eq(dy, none), hn::Gt(dx, none)));
  return hn::IfThenElse(has_edge, none, one);
}

Ints cross(Ints ax, Ints ay, Ints bx, Ints by) { return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx)); }

// Bits of the batches whose bounds overlap the points', from `first` on.
std::uint32_t overlapping(const SmallBatches& b, std::uint32_t first, const GridBox& points) {
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const std::uint32_t at = first + k;
    const auto x = hn::And(at_least(hn::Set(kInts, points.high_x), hn::Load(kInts, b.low_x + at)),
                           at_least(hn::Load(kInts, b.high_x + at), hn::Set(kInts, points.low_x)));
    const auto y = hn::And(at_least(hn::Set(kInts, points.high_y), hn::Load(kInts, b.low_y + at)),
                           at_least(hn::Load(kInts, b.high_y + at), hn::Set(kInts, points.low_y)));
    const auto z = hn::Gt(hn::Load(kFloats, b.high_z + at), constant(points.low_z));
    found |= bits(kInts, hn::And(hn::And(x, y), integers(z))) << k;
  }
  return found;
}

// Bits of the triangles whose bounds overlap the points' and that reach before the plane near them.
std::uint32_t overlapping(const SmallTriangles& t, const PointVector& points) {
  const GridBox& box = points.box;
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const auto x = hn::And(at_least(hn::Set(kInts, box.high_x), hn::Load(kInts, t.low_x + k)),
                           at_least(hn::Load(kInts, t.high_x + k), hn::Set(kInts, box.low_x)));
    const auto y = hn::And(at_least(hn::Set(kInts, box.high_y), hn::Load(kInts, t.low_y + k)),
                           at_least(hn::Load(kInts, t.high_y + k), hn::Set(kInts, box.low_y)));
    const auto z = hn::Gt(hn::Load(kFloats, t.high_z + k), constant(box.low_z));
    const auto here = hn::And(hn::And(x, y), integers(z));
    if (hn::AllFalse(kInts, here)) continue;
    const auto before = hn::Gt(highest_before(t, k, points), constant(points.least + points.room));
    found |= bits(kInts, hn::And(here, integers(before))) << k;
  }
  return found;
}

// Where a lane's triangle is before its point by more than both grids' rounding, and covers it. `inside`: lanes whose
// points lie within their triangles' bounds, where no edge function overflows. Both come from arrays of lanes or from
// one number for all of them.
template <typename OfTriangle, typename OfPoint>
hn::Mask<IntTag> covered(hn::Mask<IntTag> inside, const SmallTriangles& t, const PointVector& points,
                         const OfTriangle& triangle, const OfPoint& point) {
  const Ints x = point(points.x), y = point(points.y);
  const Ints dx = hn::Sub(x, triangle(t.x[0])), dy = hn::Sub(y, triangle(t.y[0]));
  const Floats there = hn::Add(hn::Add(triangle(t.z[0]), hn::Mul(hn::ConvertTo(kFloats, dy), triangle(t.per_y))),
                               hn::Mul(hn::ConvertTo(kFloats, dx), triangle(t.per_x)));
  const Floats z = point(points.z), size = points.has_place ? z : constant(1.0f);
  const Floats bound = hn::Mul(point(points.error), hn::Add(triangle(t.slope), size));
  inside = hn::And(inside, integers(hn::Gt(hn::Sub(there, z), bound)));
  if (hn::AllFalse(kInts, inside)) return inside;
  for (int e = 0; e < 3; ++e) {
    const int to = e == 2 ? 0 : e + 1;
    const Ints from_x = triangle(t.x[e]), from_y = triangle(t.y[e]);
    const Ints function = cross(hn::Sub(triangle(t.x[to]), from_x), hn::Sub(triangle(t.y[to]), from_y),
                                hn::Sub(x, from_x), hn::Sub(y, from_y));
    inside = hn::And(inside, at_least(function, triangle(t.least[e])));
  }
  return inside;
}

struct OfLanes {  // from lane k on
  std::uint32_t k;
  Ints operator()(const std::int32_t* all) const { return hn::Load(kInts, all + k); }
  Floats operator()(const float* all) const { return hn::Load(kFloats, all + k); }
};

struct OfOne {
  std::uint32_t number;
  Ints operator()(const std::int32_t* all) const { return hn::Set(kInts, all[number]); }
  Floats operator()(const float* all) const { return constant(all[number]); }
};

template <typename OfTriangle, typename OfPoint>
hn::Mask<IntTag> within_bounds(const SmallTriangles& t, const PointVector& points, const OfTriangle& triangle,
                               const OfPoint& point) {
  const Ints x = point(points.x), y = point(points.y);
  const auto across = hn::And(at_least(x, triangle(t.low_x)), at_least(triangle(t.high_x), x));
  return hn::And(across, hn::And(at_least(y, triangle(t.low_y)), at_least(triangle(t.high_y), y)));
}

// Bits of the points that are inside the triangle and behind it.
std::uint32_t behind(const SmallTriangles& t, std::uint32_t n, const PointVector& points) {
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const OfOne triangle{n};
    const OfLanes point{k};
    const auto inside = within_bounds(t, points, triangle, point);
    if (!hn::AllFalse(kInts, inside)) found |= bits(kInts, covered(inside, t, points, triangle, point)) << k;
  }
  return found;
}

// Whether the point is inside any of the triangles and behind it.
bool is_behind_any(const SmallTriangles& t, std::uint32_t n, const PointVector& points) {
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const OfLanes triangle{k};
    const OfOne point{n};
    const auto inside = within_bounds(t, points, triangle, point);
    if (!hn::AllFalse(kInts, inside) && !hn::AllFalse(kInts, covered(inside, t, points, triangle, point))) return true;
  }
  return false;
}

// Bits of the open points within the bounds of batch n.
std::uint32_t open_within(const SmallBatches& b, std::uint32_t n, const PointVector& points) {
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const Ints x = hn::Load(kInts, points.x + k), y = hn::Load(kInts, points.y + k);
    const auto across = hn::And(at_least(x, hn::Set(kInts, b.low_x[n])), at_least(hn::Set(kInts, b.high_x[n]), x));
    const auto along = hn::And(at_least(y, hn::Set(kInts, b.low_y[n])), at_least(hn::Set(kInts, b.high_y[n]), y));
    const auto below = hn::Lt(hn::Load(kFloats, points.z + k), constant(b.high_z[n]));
    found |= bits(kInts, hn::And(hn::And(across, along), integers(below))) << k;
  }
  return found & points.active & ~points.blocked;
}

// Takes whichever are fewer one by one, the triangles or the points.
void block(const SmallBatches& batches, std::uint32_t number, PointVector& points) {
  std::uint32_t open = open_within(batches, number, points);
  if (open == 0) return;
  const SmallTriangles& batch = batches.batch[number];
  std::uint32_t before = overlapping(batch, points);
  if (before == 0) return;
  if (__builtin_popcount(open) < __builtin_popcount(before)) {
    for (; open != 0; open &= open - 1)
      if (is_behind_any(batch, static_cast<std::uint32_t>(__builtin_ctz(open)), points)) points.blocked |= open & -open;
    return;
  }
  for (; before != 0 && (open & ~points.blocked) != 0; before &= before - 1)
    points.blocked |= behind(batch, static_cast<std::uint32_t>(__builtin_ctz(before)), points) & points.active;
}

}  // namespace

std::uint32_t set_up(const LightView& view, const GridVertices& vertices, const shape::Triangles& triangles,
                     const shape::Batch& batch, const GridBox& where, SmallBatches& batches) {
  SmallTriangles& out = batches.batch[batches.count];
  constexpr std::int32_t kMost = kMostSteps;
  const Ints none = hn::Zero(kInts), off = hn::Set(kInts, kOffGrid);
  std::uint32_t large = 0;
  GridBox box{kMost, -kMost, kMost, -kMost, 0, -kFar};
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const auto there =
        k + batch.first < batch.last ? hn::FirstN(kInts, batch.last - batch.first - k) : hn::FirstN(kInts, 0);
    const Corner a(vertices, triangles.a + batch.first, k);
    Corner b(vertices, triangles.b + batch.first, k), c(vertices, triangles.c + batch.first, k);
    const Ints low_x = hn::Min(a.x, hn::Min(b.x, c.x)), high_x = hn::Max(a.x, hn::Max(b.x, c.x));
    const Ints low_y = hn::Min(a.y, hn::Min(b.y, c.y)), high_y = hn::Max(a.y, hn::Max(b.y, c.y));
    const Ints most = hn::Set(kInts, kMostSmall);
    const auto on = hn::Ne(low_x, off);
    const auto small =
        hn::And(on, hn::And(at_least(most, hn::Sub(high_x, low_x)), at_least(most, hn::Sub(high_y, low_y))));
    large |= bits(kInts, hn::AndNot(small, there)) << k;
    const auto meets =
        hn::And(hn::And(at_least(high_x, hn::Set(kInts, where.low_x)), at_least(hn::Set(kInts, where.high_x), low_x)),
                hn::And(at_least(high_y, hn::Set(kInts, where.low_y)), at_least(hn::Set(kInts, where.high_y), low_y)));
    if (hn::AllFalse(kInts, hn::And(meets, hn::And(small, there)))) {
      hn::Store(hn::Set(kInts, kMost), kInts, out.low_x + k);
      hn::Store(hn::Set(kInts, -kMost), kInts, out.high_x + k);
      continue;
    }
    Ints x1 = hn::Sub(b.x, a.x), y1 = hn::Sub(b.y, a.y), x2 = hn::Sub(c.x, a.x), y2 = hn::Sub(c.y, a.y);
    const Ints area = hn::IfThenElseZero(small, cross(x1, y1, x2, y2));
    const auto turned = hn::Lt(area, none);
    const auto swap = [&](auto& one, auto& other, auto mask) {
      const auto before = one;
      one = hn::IfThenElse(mask, other, one);
      other = hn::IfThenElse(mask, before, other);
    };
    swap(b.x, c.x, turned), swap(b.y, c.y, turned), swap(b.z, c.z, floats(turned));
    swap(x1, x2, turned), swap(y1, y2, turned);
    const Floats inverse = hn::Div(constant(1.0f), hn::ConvertTo(kFloats, hn::Abs(area)));
    const Floats z1 = hn::Sub(b.z, a.z), z2 = hn::Sub(c.z, a.z);
    const auto number = [](Ints i) { return hn::ConvertTo(kFloats, i); };
    const Floats per_x = hn::Mul(hn::Sub(hn::Mul(z1, number(y2)), hn::Mul(z2, number(y1))), inverse);
    const Floats per_y = hn::Mul(hn::Sub(hn::Mul(z2, number(x1)), hn::Mul(z1, number(x2))), inverse);
    // Those without area, too: their slope is infinite or no number, so that they block nothing, but seen from another
    // point of a light they may have one (touch.cpp).
    const auto drawn = hn::And(small, there);
    const Ints *xs[3] = {&a.x, &b.x, &c.x}, *ys[3] = {&a.y, &b.y, &c.y};
    for (int e = 0; e < 3; ++e) {
      const int to = e == 2 ? 0 : e + 1;
      hn::Store(*xs[e], kInts, out.x[e] + k);
      hn::Store(*ys[e], kInts, out.y[e] + k);
      hn::Store(least_inside(hn::Sub(*xs[to], *xs[e]), hn::Sub(*ys[to], *ys[e])), kInts, out.least[e] + k);
    }
    const Floats* zs[3] = {&a.z, &b.z, &c.z};
    for (int e = 0; e < 3; ++e) hn::Store(*zs[e], kFloats, out.z[e] + k);
    hn::Store(per_x, kFloats, out.per_x + k);
    hn::Store(per_y, kFloats, out.per_y + k);
    hn::Store(hn::Mul(hn::Add(hn::Abs(per_x), hn::Abs(per_y)), constant(view.per_step)), kFloats, out.slope + k);
    const Floats high_z = hn::Max(a.z, hn::Max(b.z, c.z));
    const Ints lows[2] = {hn::IfThenElse(drawn, low_x, hn::Set(kInts, kMost)),
                          hn::IfThenElse(drawn, low_y, hn::Set(kInts, kMost))};
    const Ints highs[2] = {hn::IfThenElse(drawn, high_x, hn::Set(kInts, -kMost)),
                           hn::IfThenElse(drawn, high_y, hn::Set(kInts, -kMost))};
    const Floats high = hn::IfThenElse(floats(drawn), high_z, constant(-kFar));
    hn::Store(lows[0], kInts, out.low_x + k);
    hn::Store(highs[0], kInts, out.high_x + k);
    hn::Store(lows[1], kInts, out.low_y + k);
    hn::Store(highs[1], kInts, out.high_y + k);
    hn::Store(high, kFloats, out.high_z + k);
    const auto least = [](std::int32_t so_far, Ints v) {
      const std::int32_t here = MARS_SET::least(kInts, v);
      return here < so_far ? here : so_far;
    };
    const auto greatest = [](std::int32_t so_far, Ints v) {
      const std::int32_t here = MARS_SET::greatest(kInts, v);
      return here > so_far ? here : so_far;
    };
    box.low_x = least(box.low_x, lows[0]), box.high_x = greatest(box.high_x, highs[0]);
    box.low_y = least(box.low_y, lows[1]), box.high_y = greatest(box.high_y, highs[1]);
    const float highest = MARS_SET::greatest(kFloats, high);
    box.high_z = highest > box.high_z ? highest : box.high_z;
  }
  batches.low_x[batches.count] = box.low_x, batches.high_x[batches.count] = box.high_x;
  batches.low_y[batches.count] = box.low_y, batches.high_y[batches.count] = box.high_y;
  batches.high_z[batches.count++] = box.high_z;
  return large;
}

std::uint32_t find(const BoxArrays& boxes, std::uint32_t first, std::uint32_t count, const GridBox& box, float spread,
                   std::uint32_t* found) {
  std::uint32_t* next = found;
  const Floats low_x = constant(static_cast<float>(box.low_x)), high_x = constant(static_cast<float>(box.high_x));
  const Floats low_y = constant(static_cast<float>(box.low_y)), high_y = constant(static_cast<float>(box.high_y));
  for (std::uint32_t k = first; k < first + count; k += kLanes) {
    const Floats height = hn::Sub(constant(box.high_z), hn::LoadU(kFloats, boxes.low_z + k));
    const Floats margin = hn::Mul(height, constant(spread));
    const auto x = hn::And(hn::Le(hn::Sub(low_x, margin), hn::LoadU(kFloats, boxes.high_x + k)),
                           hn::Ge(hn::Add(high_x, margin), hn::LoadU(kFloats, boxes.low_x + k)));
    const auto y = hn::And(hn::Le(hn::Sub(low_y, margin), hn::LoadU(kFloats, boxes.high_y + k)),
                           hn::Ge(hn::Add(high_y, margin), hn::LoadU(kFloats, boxes.low_y + k)));
    std::uint32_t left = bits(kFloats, hn::And(hn::And(x, y), hn::Gt(height, constant(0.0f))));
    for (; left != 0; left &= left - 1) *next++ = k + static_cast<std::uint32_t>(__builtin_ctz(left));
  }
  return static_cast<std::uint32_t>(next - found);
}

// A place's height over the plane is rounded by less than kRounding times the numbers that it is the sum of.
std::uint32_t find_below(const GridHull& hull, const Shaft& shaft, const PointVector* points, std::uint32_t* found,
                         std::uint32_t found_count) {
  constexpr float kRounding = 1.0f / (1 << 21);
  std::uint32_t left = 0;
  for (std::uint32_t i = 0; i < found_count; ++i) {
    const PointVector& here = points[found[i]];
    const float tilt = magnitude(here.per_x) + magnitude(here.per_y);
    if (shaft.spread * tilt > kMostRise) {
      found[left++] = found[i];
      continue;
    }
    const Floats limit = constant(here.least + room(here, shaft) - hull.margin * tilt - hull.margin_z);
    const Floats per_x = constant(here.per_x), per_y = constant(here.per_y);
    bool reaches = false;
    for (std::uint32_t k = 0; k < hull.count; k += kLanes) {
      const Floats x = hn::ConvertTo(kFloats, hn::Sub(hn::Load(kInts, hull.x + k), hn::Set(kInts, here.box.low_x)));
      const Floats y = hn::ConvertTo(kFloats, hn::Sub(hn::Load(kInts, hull.y + k), hn::Set(kInts, here.box.low_y)));
      const Floats z = hn::Load(kFloats, hull.z + k), along_x = hn::Mul(per_x, x), along_y = hn::Mul(per_y, y);
      const Floats size = hn::Add(hn::Add(hn::Abs(along_x), hn::Abs(along_y)), hn::Abs(z));
      const Floats height = hn::Add(hn::Sub(z, hn::Add(along_x, along_y)), hn::Mul(size, constant(kRounding)));
      const auto there = hn::FirstN(kFloats, hull.count - k);
      reaches |= !hn::AllFalse(kFloats, hn::AndNot(hn::Lt(height, limit), there));
    }
    found[left] = found[i];
    left += reaches;
  }
  return left;
}

static void fetch(const PointVector& points) {
  constexpr std::size_t kCacheLine = 64;
  for (std::size_t k = 0; k < sizeof points; k += kCacheLine)
    __builtin_prefetch(reinterpret_cast<const std::byte*>(&points) + k);
}

// Behind the last batch of a sixteen lie batches of earlier calls: their bits are left out.
void block(const SmallBatches& batches, PointVector* points, const std::uint32_t* found, std::uint32_t found_count) {
  for (const std::uint32_t* at = found; at != found + found_count; ++at) {
    if (at + kAhead < found + found_count) fetch(points[at[kAhead]]);
    PointVector& here = points[*at];
    for (std::uint32_t first = 0; first < batches.count; first += kPointLanes) {
      const std::uint32_t rest = batches.count - first, all = rest < kPointLanes ? (1u << rest) - 1 : 0xffffu;
      std::uint32_t some = overlapping(batches, first, here.box) & all;
      for (; some != 0; some &= some - 1) block(batches, first + static_cast<std::uint32_t>(__builtin_ctz(some)), here);
    }
  }
}

}  // namespace mars::shadow::MARS_SET
