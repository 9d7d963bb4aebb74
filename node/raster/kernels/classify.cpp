// Sixteen triangles at a time: which way they face, which samples they cover. In 32-bit integers, exact for
// triangles no larger than kMostExtent: places relative to the triangle stay below 2^15, sums of products below 2^31.
#include <cstdint>

#include "node/raster/kernels/functions.h"

namespace mars::raster::MARS_SET {

using namespace simd::MARS_SET;

namespace {

using Mask = hn::Mask<IntTag>;

Ints constant(std::int32_t number) { return hn::Set(kInts, number); }

struct Point {
  Ints x, y;
};

// So that a's y is the lesser one.
void order(Point& a, Point& b) {
  const Mask swap = hn::Lt(b.y, a.y);
  const Point was = a;
  a = {hn::IfThenElse(swap, b.x, a.x), hn::IfThenElse(swap, b.y, a.y)};
  b = {hn::IfThenElse(swap, was.x, b.x), hn::IfThenElse(swap, was.y, b.y)};
}

// First row or column whose sample lies at or after a place.
Ints sample_after(Ints place) { return hn::ShiftRight<8>(hn::Add(place, constant(shape::kSampleOffset - 1))); }

// A side's crossing of a row is (numerator / denominator) columns from where columns are counted.
struct Side {
  Ints numerator, step, denominator;
  Floats inverse;

  // At the row of sample place `y`, columns counted from sample place `x`.
  Side(const Point& from, const Point& to, Ints x, Ints y) {
    const Ints dx = hn::Sub(to.x, from.x), dy = hn::Sub(to.y, from.y);
    numerator = hn::Add(hn::Mul(hn::Sub(y, from.y), dx), hn::Mul(hn::Sub(from.x, x), dy));
    step = hn::ShiftLeft<8>(dx);
    denominator = hn::ShiftLeft<8>(dy);
    inverse = hn::Div(hn::Set(kFloats, 1.0f), hn::ConvertTo(kFloats, denominator));
  }
  void next_row() { numerator = hn::Add(numerator, step); }
};

// The quotient rounded up. Its estimate, rounded to the nearest, is that or one less: its error is far below 1/2.
Ints first_sample(Ints numerator, Ints denominator, Floats inverse) {
  const Ints estimate = hn::NearestInt(hn::Mul(hn::ConvertTo(kFloats, numerator), inverse));
  const Mask low = hn::Lt(hn::Mul(estimate, denominator), numerator);
  return hn::Sub(estimate, hn::VecFromMask(kInts, low));
}

std::uint32_t bits(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kInts, mask, bytes);
  return (bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8) & ((1u << kLanes) - 1);
}

struct Triangle3 {
  Point a, b, c;
};

Triangle3 load(const shape::Vertices& v, const shape::Triangles& triangles, std::uint32_t at, bool consecutive) {
  const auto corner = [&](const std::uint32_t* numbers) {
    const std::uint32_t first = numbers[at];
    if (consecutive) return Point{hn::LoadU(kInts, v.x + first), hn::LoadU(kInts, v.y + first)};
    const Ints number = hn::LoadU(kInts, reinterpret_cast<const std::int32_t*>(numbers) + at);
    return Point{hn::GatherIndex(kInts, v.x, number), hn::GatherIndex(kInts, v.y, number)};
  };
  return {corner(triangles.a), corner(triangles.b), corner(triangles.c)};
}

// Columns of those that `may` cover samples, row by row; which of them do.
Mask set_columns(Triangle3 t, Ints left, Ints first_row, Ints last_row, Mask may, std::int32_t width,
                 std::uint32_t lane, Classified& out) {
  order(t.a, t.b);
  order(t.b, t.c);
  order(t.a, t.b);
  const Ints column = hn::ShiftRight<8>(left);
  const Ints x = hn::Add(hn::ShiftLeft<8>(column), constant(shape::kSampleOffset));
  Ints y = hn::Add(hn::ShiftLeft<8>(first_row), constant(shape::kSampleOffset));
  Side full(t.a, t.c, x, y), upper(t.a, t.b, x, y), lower(t.b, t.c, x, y);
  const Ints end = hn::IfThenElseZero(may, hn::ShiftLeft<8>(last_row));
  Mask covers = hn::Lt(y, y);
  for (std::int32_t r = 0;; ++r) {
    const Mask within = hn::Lt(y, end);
    if (hn::AllFalse(kInts, within)) return covers;
    const Mask above = hn::Lt(y, t.b.y);
    const Ints one = first_sample(full.numerator, full.denominator, full.inverse);
    const Ints other = first_sample(hn::IfThenElse(above, upper.numerator, lower.numerator),
                                    hn::IfThenElse(above, upper.denominator, lower.denominator),
                                    hn::IfThenElse(hn::RebindMask(kFloats, above), upper.inverse, lower.inverse));
    const Ints first = hn::Max(hn::Add(hn::Min(one, other), column), hn::Zero(kInts));
    const Ints last = hn::Min(hn::Add(hn::Max(one, other), column), constant(width));
    const Mask covered = hn::And(within, hn::Lt(first, last));
    const Ints columns = hn::IfThenElseZero(covered, hn::Or(first, hn::ShiftLeft<16>(last)));
    hn::Store(columns, kInts, reinterpret_cast<std::int32_t*>(out.columns[r]) + lane);
    covers = hn::Or(covers, covered);
    y = hn::Add(y, constant(shape::kSubpixels));
    full.next_row();
    upper.next_row();
    lower.next_row();
  }
}

}  // namespace

void classify(const ClassifyTask& task, const shape::Vertices& v, const shape::Triangles& triangles,
              const shape::Batch& batch, Classified& out) {
  out.decided = out.undecided = out.faces = 0;
  const std::uint32_t count = batch.last - batch.first;
  for (std::uint32_t lane = 0; lane < count; lane += kLanes) {
    const Triangle3 t = load(v, triangles, batch.first + lane, batch.consecutive);
    const Ints x1 = hn::Sub(t.b.x, t.a.x), y1 = hn::Sub(t.b.y, t.a.y), x2 = hn::Sub(t.c.x, t.a.x),
               y2 = hn::Sub(t.c.y, t.a.y);
    const Ints longest = hn::Max(hn::Max(hn::Abs(x1), hn::Abs(x2)), hn::Max(hn::Abs(y1), hn::Abs(y2)));
    const Mask small = hn::Lt(longest, constant(kMostExtent * shape::kSubpixels / 2));
    const Ints area = hn::Sub(hn::Mul(x1, y2), hn::Mul(x2, y1));
    const Ints lengths = hn::Add(hn::Add(hn::Abs(x1), hn::Abs(y1)), hn::Add(hn::Abs(x2), hn::Abs(y2)));
    const Mask sure = hn::And(small, hn::Gt(hn::Abs(area), hn::Mul(constant(kThin), lengths)));
    const Mask faces = hn::Lt(area, hn::Zero(kInts));
    const Mask away = !task.one_sided ? hn::Lt(area, area) : task.mirrored ? faces : hn::Not(faces);
    const Mask flat = hn::And(small, hn::Eq(area, hn::Zero(kInts)));
    const Mask left_over = hn::AndNot(hn::Or(flat, hn::And(sure, away)), hn::FirstN(kInts, count - lane));
    if (hn::AllFalse(kInts, left_over)) continue;

    const Ints left = hn::Min(hn::Min(t.a.x, t.b.x), t.c.x), right = hn::Max(hn::Max(t.a.x, t.b.x), t.c.x);
    const Ints top = hn::Min(hn::Min(t.a.y, t.b.y), t.c.y), bottom = hn::Max(hn::Max(t.a.y, t.b.y), t.c.y);
    const Ints first_row = hn::Max(sample_after(top), hn::Zero(kInts));
    const Ints last_row = hn::Min(sample_after(bottom), constant(task.height));
    const Ints first_column = hn::Max(sample_after(left), hn::Zero(kInts));
    const Ints last_column = hn::Min(sample_after(right), constant(task.width));
    const Mask touches = hn::And(left_over, hn::And(hn::Lt(first_row, last_row), hn::Lt(first_column, last_column)));
    out.undecided |= bits(hn::AndNot(sure, touches)) << lane;
    const Mask may = hn::And(touches, sure);
    if (hn::AllFalse(kInts, may)) continue;

    const Mask covers = set_columns(t, left, first_row, last_row, may, task.width, lane, out);
    out.decided |= bits(covers) << lane;
    out.faces |= bits(faces) << lane;
    hn::Store(first_row, kInts, out.first_row + lane);
    hn::Store(last_row, kInts, out.last_row + lane);
    hn::Store(hn::ConvertTo(kFloats, x1), kFloats, out.x1 + lane);
    hn::Store(hn::ConvertTo(kFloats, y1), kFloats, out.y1 + lane);
    hn::Store(hn::ConvertTo(kFloats, x2), kFloats, out.x2 + lane);
    hn::Store(hn::ConvertTo(kFloats, y2), kFloats, out.y2 + lane);
    hn::Store(hn::Div(hn::Set(kFloats, 1.0f), hn::ConvertTo(kFloats, area)), kFloats, out.inverse + lane);
  }
}

}  // namespace mars::raster::MARS_SET
