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

// First row whose samples lie at or after y.
Ints row_after(Ints y, const shape::SamplePattern& pattern) {
  return hn::ShiftRight<8>(hn::Add(hn::Mul(y, constant(pattern.count)), constant(shape::kSubpixels / 2 - 1)));
}

// A side's crossing of a row is (numerator / denominator) columns from where columns are counted.
struct Side {
  Ints numerator, step, height, denominator;
  Floats inverse;

  // At the row of sample place `y`, columns counted from place `x`.
  Side(const Point& from, const Point& to, Ints x, Ints y, const shape::SamplePattern& pattern) {
    const Ints dx = hn::Sub(to.x, from.x);
    height = hn::Sub(to.y, from.y);
    numerator = hn::Add(hn::Mul(hn::Sub(y, from.y), dx), hn::Mul(hn::Sub(from.x, x), height));
    step = hn::Mul(dx, constant(shape::kSubpixels / pattern.count));
    denominator = hn::ShiftLeft<8>(height);
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

// Rows that a triangle may touch, of the picture's.
struct Rows {
  Ints first, last;
};

// Columns of those that `may` cover samples, row by row from line `line` on; which of them do. `kOne`: one sample a
// pixel, all at the same x.
template <bool kOne>
Mask set_columns(Triangle3 t, Ints left, Ints line, const Rows& rows, Mask may, const ClassifyTask& task,
                 std::uint32_t lane, Classified& out) {
  const shape::SamplePattern& pattern = task.pattern;
  order(t.a, t.b);
  order(t.b, t.c);
  order(t.a, t.b);
  const Ints column = hn::ShiftRight<8>(left);
  const Ints x = hn::Add(hn::ShiftLeft<8>(column), constant(kOne ? pattern.x[0] : 0));
  Ints y = hn::Add(hn::ShiftLeft<8>(line), constant(pattern.y[0]));
  Side full(t.a, t.c, x, y, pattern), upper(t.a, t.b, x, y, pattern), lower(t.b, t.c, x, y, pattern);
  const Ints row_height = constant(shape::kSubpixels / pattern.count);
  const Ints begin = hn::Mul(rows.first, row_height);
  const Ints end = hn::IfThenElseZero(may, hn::Mul(rows.last, row_height));
  Mask covers = hn::Lt(y, y);
  for (std::int32_t r = 0;; ++r) {
    Mask within = hn::Lt(y, end);
    if (hn::AllFalse(kInts, within)) return covers;
    if constexpr (!kOne) within = hn::And(within, hn::Gt(y, begin));
    const Mask above = hn::Lt(y, t.b.y);
    Ints long_numerator = full.numerator, short_numerator = hn::IfThenElse(above, upper.numerator, lower.numerator);
    if constexpr (!kOne) {
      const Ints sample_x = constant(pattern.x[r & (pattern.count - 1)]);
      long_numerator = hn::Sub(long_numerator, hn::Mul(sample_x, full.height));
      short_numerator = hn::Sub(short_numerator, hn::Mul(sample_x, hn::IfThenElse(above, upper.height, lower.height)));
    }
    const Ints one = first_sample(long_numerator, full.denominator, full.inverse);
    const Ints other = first_sample(short_numerator, hn::IfThenElse(above, upper.denominator, lower.denominator),
                                    hn::IfThenElse(hn::RebindMask(kFloats, above), upper.inverse, lower.inverse));
    const Ints first = hn::Max(hn::Add(hn::Min(one, other), column), hn::Zero(kInts));
    const Ints last = hn::Min(hn::Add(hn::Max(one, other), column), constant(task.width));
    const Mask covered = hn::And(within, hn::Lt(first, last));
    const Ints columns = hn::IfThenElseZero(covered, hn::Or(first, hn::ShiftLeft<16>(last)));
    hn::Store(columns, kInts, reinterpret_cast<std::int32_t*>(out.columns[r]) + lane);
    covers = hn::Or(covers, covered);
    y = hn::Add(y, row_height);
    full.next_row();
    upper.next_row();
    lower.next_row();
  }
}

// Columns that hold all samples between `left` and `right`.
struct Columns {
  Ints first, last;
};
Columns column_bounds(Ints left, Ints right, const ClassifyTask& task) {
  std::int32_t least = task.pattern.x[0], most = least;
  for (std::int32_t s = 1; s < task.pattern.count; ++s) {
    const std::int32_t x = task.pattern.x[s];
    least = x < least ? x : least;
    most = x > most ? x : most;
  }
  const auto column_after = [](Ints place, std::int32_t x) {
    return hn::ShiftRight<8>(hn::Add(place, constant(shape::kSubpixels - 1 - x)));
  };
  return {hn::Max(column_after(left, most), hn::Zero(kInts)),
          hn::Min(column_after(right, least), constant(task.width))};
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
    const shape::SamplePattern& pattern = task.pattern;
    const Rows rows{hn::Max(row_after(top, pattern), hn::Zero(kInts)),
                    hn::Min(row_after(bottom, pattern), constant(task.height * pattern.count))};
    const Columns columns = column_bounds(left, right, task);
    const Mask touches =
        hn::And(left_over, hn::And(hn::Lt(rows.first, rows.last), hn::Lt(columns.first, columns.last)));
    out.undecided |= bits(hn::AndNot(sure, touches)) << lane;
    const Mask may = hn::And(touches, sure);
    if (hn::AllFalse(kInts, may)) continue;

    const Ints first_line = hn::ShiftRightSame(rows.first, pattern.log2_count);
    const auto set_columns = pattern.count == 1 ? MARS_SET::set_columns<true> : MARS_SET::set_columns<false>;
    const Mask covers = set_columns(t, left, first_line, rows, may, task, lane, out);
    out.decided |= bits(covers) << lane;
    out.faces |= bits(faces) << lane;
    const Ints first_row = hn::ShiftLeftSame(first_line, pattern.log2_count);
    hn::Store(first_line, kInts, out.first_line + lane);
    hn::Store(hn::Sub(rows.first, first_row), kInts, out.first_row + lane);
    hn::Store(hn::Sub(rows.last, first_row), kInts, out.last_row + lane);
    hn::Store(hn::ConvertTo(kFloats, x1), kFloats, out.x1 + lane);
    hn::Store(hn::ConvertTo(kFloats, y1), kFloats, out.y1 + lane);
    hn::Store(hn::ConvertTo(kFloats, x2), kFloats, out.x2 + lane);
    hn::Store(hn::ConvertTo(kFloats, y2), kFloats, out.y2 + lane);
    hn::Store(hn::Div(hn::Set(kFloats, 1.0f), hn::ConvertTo(kFloats, area)), kFloats, out.inverse + lane);
  }
}

}  // namespace mars::raster::MARS_SET
