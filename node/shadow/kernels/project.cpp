// Places of eye space on a view's grid: vertices of casters, and points.
#include <cstdint>

#include "node/shadow/kernels/functions.h"

namespace mars::shadow::MARS_SET {

namespace {

constexpr float kMostOnGrid = 1 << 29;

Floats zero() { return hn::Zero(kFloats); }

// A vector of places, seen by a view.
struct Seen {
  Floats x, y, z;
  Floats depth, across_u, across_v;  // of lights with a place
  hn::Mask<FloatTag> before;         // the light, far enough from it
  hn::Mask<FloatTag> on_grid;

  Seen(const LightView& view, Floats px, Floats py, Floats pz) {
    if (view.has_place) {
      px = hn::Sub(px, constant(view.place[0]));
      py = hn::Sub(py, constant(view.place[1]));
      pz = hn::Sub(pz, constant(view.place[2]));
    }
    const auto along = [&](const float* a) {
      return hn::Add(hn::Add(hn::Mul(constant(a[0]), px), hn::Mul(constant(a[1]), py)), hn::Mul(constant(a[2]), pz));
    };
    depth = along(view.axis), across_u = along(view.u), across_v = along(view.v);
    const Floats steps = constant(view.per_step), most = constant(kMostOnGrid);
    z = depth;
    x = across_u, y = across_v;
    before = hn::Eq(depth, depth);
    if (view.has_place) {
      before = hn::Ge(depth, constant(view.nearest));
      z = hn::Div(constant(1.0f), depth);
      x = hn::Mul(x, z), y = hn::Mul(y, z);
    }
    x = hn::Mul(x, steps), y = hn::Mul(y, steps);
    on_grid = hn::And(before, hn::And(hn::Le(hn::Abs(x), most), hn::Le(hn::Abs(y), most)));
  }
};

Ints on_grid(Floats place, hn::Mask<FloatTag> mask) {
  const Ints steps = hn::NearestInt(hn::IfThenElseZero(mask, place));
  return hn::IfThenElse(integers(mask), steps, hn::Set(kInts, kOffGrid));
}

// Grows lane by lane.
class Bounds {
 public:
  void add(Ints x, Ints y, Floats z, hn::Mask<FloatTag> mask) {
    const auto of = integers(mask);
    low_x_ = hn::Min(low_x_, hn::IfThenElse(of, x, low_x_)), high_x_ = hn::Max(high_x_, hn::IfThenElse(of, x, high_x_));
    low_y_ = hn::Min(low_y_, hn::IfThenElse(of, y, low_y_)), high_y_ = hn::Max(high_y_, hn::IfThenElse(of, y, high_y_));
    low_z_ = hn::Min(low_z_, hn::IfThenElse(mask, z, low_z_)),
    high_z_ = hn::Max(high_z_, hn::IfThenElse(mask, z, high_z_));
  }
  GridBox box() const {
    return {MARS_SET::least(kInts, low_x_),   MARS_SET::greatest(kInts, high_x_),
            MARS_SET::least(kInts, low_y_),   MARS_SET::greatest(kInts, high_y_),
            MARS_SET::least(kFloats, low_z_), MARS_SET::greatest(kFloats, high_z_)};
  }

 private:
  static constexpr std::int32_t kLow = kOffGrid;
  static constexpr std::int32_t kHigh = kMostSteps;
  Ints low_x_ = hn::Set(kInts, kHigh), high_x_ = hn::Set(kInts, kLow);
  Ints low_y_ = hn::Set(kInts, kHigh), high_y_ = hn::Set(kInts, kLow);
  Floats low_z_ = constant(kFar), high_z_ = constant(-kFar);
};

// Sums over the active points.
struct Sums {
  Floats all = zero();
  float total() const { return hn::GetLane(hn::SumOfLanes(kFloats, all)); }
};

// By least squares; level where the points lie on a line. Any plane is right, a near one leaves out more.
void fit_plane(PointVector& out) {
  Sums x, y, z, xx, xy, yy, xz, yz;
  const auto each = [&](const auto& visit) {
    for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
      const std::uint8_t asked[8] = {static_cast<std::uint8_t>(out.active >> k),
                                     static_cast<std::uint8_t>(out.active >> k >> 8)};
      const auto place = [&](const std::int32_t* at, std::int32_t low) {
        return hn::ConvertTo(kFloats, hn::Sub(hn::Load(kInts, at + k), hn::Set(kInts, low)));
      };
      visit(hn::LoadMaskBits(kFloats, asked), place(out.x, out.box.low_x), place(out.y, out.box.low_y),
            hn::Load(kFloats, out.z + k), hn::Load(kFloats, out.error + k));
    }
  };
  const auto add = [](hn::Mask<FloatTag> mask, Floats number, Sums& sum) {
    sum.all = hn::Add(sum.all, hn::IfThenElseZero(mask, number));
  };
  each([&](auto mask, Floats px, Floats py, Floats pz, Floats) {
    add(mask, px, x), add(mask, py, y), add(mask, pz, z);
  });
  const auto count = static_cast<float>(__builtin_popcount(out.active));
  const float mx = x.total() / count, my = y.total() / count, mz = z.total() / count;
  each([&](auto mask, Floats px, Floats py, Floats pz, Floats) {
    const Floats dx = hn::Sub(px, constant(mx)), dy = hn::Sub(py, constant(my)), dz = hn::Sub(pz, constant(mz));
    add(mask, hn::Mul(dx, dx), xx), add(mask, hn::Mul(dx, dy), xy), add(mask, hn::Mul(dy, dy), yy);
    add(mask, hn::Mul(dx, dz), xz), add(mask, hn::Mul(dy, dz), yz);
  });
  constexpr float kOnALine = 1e-3f;
  const float sxx = xx.total(), sxy = xy.total(), syy = yy.total(), sxz = xz.total(), syz = yz.total();
  const float determinant = sxx * syy - sxy * sxy;
  const bool is_plane = determinant > kOnALine * sxx * syy;
  out.per_x = is_plane ? (sxz * syy - syz * sxy) / determinant : 0;
  out.per_y = is_plane ? (syz * sxx - sxz * sxy) / determinant : 0;
  Floats least = constant(kFar), room = least;
  each([&](auto mask, Floats px, Floats py, Floats pz, Floats error) {
    const Floats plane = hn::Add(hn::Mul(constant(out.per_x), px), hn::Mul(constant(out.per_y), py));
    least = hn::Min(least, hn::IfThenElse(mask, hn::Sub(pz, plane), least));
    room = hn::Min(room, hn::IfThenElse(mask, hn::Mul(error, out.has_place ? pz : constant(1.0f)), room));
  });
  out.least = MARS_SET::least(kFloats, least);
  // Half of what a caster must be nearer, for points are rounded here too; and less by what a small triangle's corners
  // are rounded by.
  constexpr float kRounding = 1.0f / (1 << 22);
  const auto reach = [](float per, std::int32_t low, std::int32_t high) {
    return (per < 0 ? -per : per) * (static_cast<float>(high) - static_cast<float>(low) + kMostSmall);
  };
  const float size = reach(out.per_x, out.box.low_x, out.box.high_x) + reach(out.per_y, out.box.low_y, out.box.high_y) +
                     (out.least < 0 ? -out.least : out.least);
  out.room = MARS_SET::least(kFloats, room) / 2 - kRounding * size;
}

}  // namespace

GridBox project(const LightView& view, const float* const* place, std::uint32_t count, const GridVertices& out) {
  Bounds bounds;
  bool any_off = false, any_before = false;
  for (std::uint32_t k = 0; k < count; k += kLanes) {
    const Seen seen(view, hn::LoadU(kFloats, place[0] + k), hn::LoadU(kFloats, place[1] + k),
                    hn::LoadU(kFloats, place[2] + k));
    const Ints x = on_grid(seen.x, seen.on_grid), y = on_grid(seen.y, seen.on_grid);
    hn::StoreU(x, kInts, out.x + k);
    hn::StoreU(y, kInts, out.y + k);
    hn::StoreU(seen.z, kFloats, out.z + k);
    const auto there = hn::FirstN(kFloats, count - k);
    bounds.add(x, y, seen.z, hn::And(there, seen.on_grid));
    any_off |= !hn::AllFalse(kFloats, hn::AndNot(seen.on_grid, there));
    any_before |= !hn::AllFalse(kFloats, hn::And(there, seen.before));
  }
  constexpr std::int32_t kMost = kMostSteps;
  if (!any_before) return {1, 0, 1, 0, 0, 0};
  return any_off ? GridBox{-kMost, kMost, -kMost, kMost, -kFar, kFar} : bounds.box();
}

void put_points(const LightView& view, const PointFrame& frame, float left, float top, const LanePlaces& places,
                const float* depths, std::uint32_t active, PointVector& out) {
  Bounds bounds;
  out.active = out.blocked = out.noted = 0;
  out.has_place = view.has_place;
  const Floats per_pixel = constant(1.0f / frame.scale), across_pixel = constant(1.0f / (frame.scale * frame.squeeze));
  for (std::uint32_t k = 0; k < kPointLanes; k += kLanes) {
    const Floats x = hn::Add(constant(left + frame.origin[0]), hn::Load(kFloats, places.x + k));
    const Floats y = hn::Add(constant(top + frame.origin[1]), hn::Load(kFloats, places.y + k));
    const Floats depth = hn::LoadU(kFloats, depths + k);
    const Floats w = frame.parallel ? hn::Neg(depth) : hn::Div(constant(1.0f), depth);
    const Floats spread = frame.parallel ? constant(1.0f) : w;
    const Floats px = hn::Mul(hn::Mul(hn::Sub(x, constant(frame.center[0])), across_pixel), spread);
    const Floats py = hn::Mul(hn::Mul(hn::Sub(constant(frame.center[1]), y), per_pixel), spread);
    const Seen seen(view, px, py, hn::Neg(w));
    auto here = hn::And(seen.on_grid, hn::Gt(depth, constant(frame.nothing)));
    if (view.is_face) {
      here = hn::And(here, hn::Le(hn::Abs(seen.across_u), seen.depth));
      here = hn::And(here, hn::Le(hn::Abs(seen.across_v), seen.depth));
    }
    const std::uint8_t asked[8] = {static_cast<std::uint8_t>(active >> k), static_cast<std::uint8_t>(active >> k >> 8)};
    here = hn::And(here, hn::LoadMaskBits(kFloats, asked));
    Floats error = hn::Add(hn::Mul(hn::Add(hn::Mul(w, constant(frame.by_square)), constant(frame.by_w)), w),
                           constant(frame.everywhere));
    if (view.has_place) error = hn::Mul(hn::Add(error, hn::Mul(seen.depth, constant(frame.by_depth))), seen.z);
    const Ints grid_x = on_grid(seen.x, here), grid_y = on_grid(seen.y, here);
    hn::Store(grid_x, kInts, out.x + k);
    hn::Store(grid_y, kInts, out.y + k);
    hn::Store(hn::IfThenElseZero(here, seen.z), kFloats, out.z + k);
    hn::Store(hn::IfThenElseZero(here, error), kFloats, out.error + k);
    bounds.add(grid_x, grid_y, seen.z, here);
    out.active |= bits(kFloats, here) << k;
  }
  if (out.active == 0) return;
  out.box = bounds.box();
  fit_plane(out);
}

}  // namespace mars::shadow::MARS_SET
