#include "node/shadow/block_plainly.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace mars::shadow {
namespace {

__extension__ typedef __int128 Wide;

constexpr double kMostOnGrid = 1e17;

struct Corner {
  std::array<double, 3> place;  // of eye space, from the light's where it has one
  double depth;
  GridPlace grid;
};

double along(const float* axis, const std::array<double, 3>& place) {
  return axis[0] * place[0] + axis[1] * place[1] + axis[2] * place[2];
}

GridPlace on_grid(const LightView& view, const std::array<double, 3>& place) {
  const double z = view.has_place ? 1 / along(view.axis, place) : along(view.axis, place);
  const double scale = view.per_step * (view.has_place ? z : 1.0);
  const auto steps = [&](double across) {
    return static_cast<std::int64_t>(std::nearbyint(std::clamp(across * scale, -kMostOnGrid, kMostOnGrid)));
  };
  return {steps(along(view.u, place)), steps(along(view.v, place)), z};
}

// A vertex that is on the grid is where kernels have it, for triangles that meet there.
Corner corner(const LightView& view, const Caster& caster, const GridVertices& vertices, std::uint32_t number) {
  Corner out;
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.place[axis] = double{caster.place[axis][number]} - double{view.place[axis]};
  out.depth = along(view.axis, out.place);
  if (vertices.x[number] != kOffGrid)
    out.grid = {vertices.x[number], vertices.y[number], vertices.z[number]};
  else
    out.grid = on_grid(view, out.place);
  return out;
}

// Where the edge from a to b reaches the view's nearest depth: the same from either end.
Corner cut(const LightView& view, const Corner& a, const Corner& b) {
  if (b.place < a.place) return cut(view, b, a);
  const double part = (view.nearest - a.depth) / (b.depth - a.depth);
  Corner out;
  for (std::size_t axis = 0; axis < 3; ++axis) out.place[axis] = a.place[axis] + part * (b.place[axis] - a.place[axis]);
  out.depth = view.nearest;
  out.grid = on_grid(view, out.place);
  return out;
}

struct Polygon {
  std::array<GridPlace, 4> corner;
  std::size_t count = 0;

  void add(const GridPlace& place) { corner[count++] = place; }
};

// What of the triangle is far enough from the light.
Polygon clipped(const LightView& view, const std::array<Corner, 3>& corners) {
  Polygon out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner &from = corners[k], &to = corners[(k + 1) % 3];
    const auto is_far = [&](const Corner& at) { return !view.has_place || at.depth >= view.nearest; };
    if (is_far(from)) out.add(from.grid);
    if (is_far(from) != is_far(to)) out.add(cut(view, from, to).grid);
  }
  return out;
}

Wide cross(const GridPlace& a, const GridPlace& b, std::int64_t x, std::int64_t y) {
  return static_cast<Wide>(b.x - a.x) * (y - a.y) - static_cast<Wide>(b.y - a.y) * (x - a.x);
}

// As the kernels' edges.
Wide least_inside(const GridPlace& a, const GridPlace& b) {
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
  return dy > 0 || (dy == 0 && dx > 0) ? 0 : 1;
}

class Plane {
 public:
  Plane(const LargeTriangle& t, Wide area) : a_(t.a) {
    const GridPlace &a = t.a, &b = t.b, &c = t.c;
    const auto number = [](std::int64_t i) { return static_cast<double>(i); };
    const double z1 = b.z - a.z, z2 = c.z - a.z, inverse = 1 / static_cast<double>(area);
    per_x_ = (z1 * number(c.y - a.y) - z2 * number(b.y - a.y)) * inverse;
    per_y_ = (z2 * number(b.x - a.x) - z1 * number(c.x - a.x)) * inverse;
    slope_ = (std::abs(per_x_) + std::abs(per_y_)) * t.per_step;
  }
  // Whether it may block points from places of the light: not if it rises less than a shaft's rays and nothing of it
  // over the points' box is before the plane near them, which would be at a corner of the box.
  bool may_block(const PointVector& points, const Shaft& shaft) const {
    if (shaft.spread * (std::abs(per_x_) + std::abs(per_y_)) > double{kMostRise}) return true;
    const GridBox& box = points.box;
    const auto rise = [](double more, std::int32_t low, std::int32_t high) {
      return std::max(0.0, more * (static_cast<double>(high) - low));
    };
    const double at_low =
        a_.z + static_cast<double>(box.low_x - a_.x) * per_x_ + static_cast<double>(box.low_y - a_.y) * per_y_;
    return at_low + rise(per_x_ - points.per_x, box.low_x, box.high_x) +
               rise(per_y_ - points.per_y, box.low_y, box.high_y) >
           double{points.least} + std::min(double{points.room}, double{points.room} * shaft.room);
  }
  bool is_before(const PointVector& points, std::size_t k) const {
    const double there =
        a_.z + static_cast<double>(points.y[k] - a_.y) * per_y_ + static_cast<double>(points.x[k] - a_.x) * per_x_;
    const double size = points.has_place ? double{points.z[k]} : 1.0;
    return there - points.z[k] > points.error[k] * (slope_ + size);
  }

 private:
  GridPlace a_;
  double per_x_, per_y_, slope_;
};

}  // namespace

GridBox LargeTriangle::box() const {
  const auto steps = [](std::int64_t place) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::clamp(place, -kMost, kMost));
  };
  const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
  const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
  const auto [low_z, high_z] = std::minmax({a.z, b.z, c.z});
  return {steps(low_x),
          steps(high_x),
          steps(low_y),
          steps(high_y),
          static_cast<float>(low_z),
          std::nextafter(static_cast<float>(high_z), std::numeric_limits<float>::max())};
}

void for_each_piece(const LightView& view, const Caster& caster, const GridVertices& vertices, std::uint32_t number,
                    const std::function<void(const LargeTriangle&)>& visit) {
  const shape::Corner3 at = caster.triangles[number];
  const Polygon polygon = clipped(view, {corner(view, caster, vertices, at.a), corner(view, caster, vertices, at.b),
                                         corner(view, caster, vertices, at.c)});
  for (std::size_t k = 1; k + 1 < polygon.count; ++k)
    visit({polygon.corner[0], polygon.corner[k], polygon.corner[k + 1], view.per_step});
}

void visit_behind(const LargeTriangle& triangle, const Shaft& shaft, const PointVector* points,
                  std::span<const std::uint32_t> found, const std::function<void(std::uint32_t)>& visit) {
  const Wide area = cross(triangle.a, triangle.b, triangle.c.x, triangle.c.y);
  if (area == 0) return;
  const Plane plane(triangle, area);
  for (const std::uint32_t number : found)
    if (plane.may_block(points[number], shaft)) visit(number);
}

void block_plainly(const LargeTriangle& triangle, PointVector* points, std::span<const std::uint32_t> found) {
  GridPlace a = triangle.a, b = triangle.b, c = triangle.c;
  Wide area = cross(a, b, c.x, c.y);
  if (area == 0) return;
  if (area < 0) std::swap(b, c), area = -area;
  const Plane plane({a, b, c, triangle.per_step}, area);
  const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
  const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
  const double high_z = std::max({a.z, b.z, c.z});
  const Wide least[3] = {least_inside(a, b), least_inside(b, c), least_inside(c, a)};
  for (const std::uint32_t number : found) {
    PointVector& here = points[number];
    if (here.box.low_x > high_x || here.box.high_x < low_x || here.box.low_y > high_y || here.box.high_y < low_y ||
        !(high_z > here.box.low_z) || !plane.may_block(here, kRay))
      continue;
    for (std::uint32_t left = here.active & ~here.blocked; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      const std::int64_t x = here.x[k], y = here.y[k];
      if (plane.is_before(here, k) && cross(a, b, x, y) >= least[0] && cross(b, c, x, y) >= least[1] &&
          cross(c, a, x, y) >= least[2])
        here.blocked |= 1u << k;
    }
  }
}

}  // namespace mars::shadow
