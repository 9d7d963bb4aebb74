#include "node/shadow/grid_caster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "node/simd/vector_slack.h"

namespace mars::shadow {
namespace {

constexpr float kPlaceError = 1.0f / (1 << 20);

float largest(const Hull& hull) {
  float most = 0;
  for (const auto& along : hull.along)
    for (std::uint32_t k = 0; k < hull.count; ++k) most = std::max(most, std::abs(along[k]));
  return most;
}

std::int32_t clamped(double steps) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(steps, -kMost, kMost));
}

double number(std::int32_t steps) { return steps; }

// A plane that no place of a hull is before.
class Lid {
 public:
  explicit Lid(const GridHull& hull) : x_(hull.x[0]), y_(hull.y[0]) {
    constexpr std::uint32_t kOfPatch = 16;
    if (hull.count == kOfPatch) tilt(hull);
    const auto above = [&](std::uint32_t k) {
      return hull.z[k] - per_x_ * (hull.x[k] - x_) - per_y_ * (hull.y[k] - y_);
    };
    z_ = above(0);
    for (std::uint32_t k = 1; k < hull.count; ++k) z_ = std::max(z_, above(k));
    z_ += hull.margin * (std::abs(per_x_) + std::abs(per_y_)) + hull.margin_z;
  }

  double tilt() const { return std::abs(per_x_) + std::abs(per_y_); }
  // Whether it is anywhere before the plane near the points, over their box: at a corner, if at all.
  bool is_before(const PointVector& points, const Shaft& shaft) const {
    const GridBox& box = points.box;
    const double room = double{points.room};
    const double low = z_ + per_x_ * (box.low_x - x_) + per_y_ * (box.low_y - y_);
    const double rise_x = (per_x_ - points.per_x) * (number(box.high_x) - number(box.low_x));
    const double rise_y = (per_y_ - points.per_y) * (number(box.high_y) - number(box.low_y));
    return low + std::max(rise_x, 0.0) + std::max(rise_y, 0.0) >
           double{points.least} + std::min(room, room * shaft.room);
  }

 private:
  // As a patch's corners are.
  void tilt(const GridHull& hull) {
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      return std::array{number(hull.x[b]) - number(hull.x[a]), number(hull.y[b]) - number(hull.y[a]),
                        double{hull.z[b]} - hull.z[a]};
    };
    const auto [ax, ay, az] = between(0, 15);
    const auto [bx, by, bz] = between(3, 12);
    const double area = ax * by - ay * bx;
    if (area == 0) return;
    per_x_ = (az * by - bz * ay) / area;
    per_y_ = (bz * ax - az * bx) / area;
  }

  double x_, y_, z_;
  double per_x_ = 0, per_y_ = 0;
};

}  // namespace

GridCaster::GridCaster(const ShadowKernels& kernels)
    : kernels_(kernels),
      x_(static_cast<std::size_t>(shape::Dicer::kMostVertices + simd::kVectorSlack)),
      y_(x_.size()),
      z_(x_.size()),
      vertices_{x_.data(), y_.data(), z_.data()},
      small_(new SmallBatches{}) {}

// A little wider, for vertices lie within the hull but for rounding.
GridBox GridCaster::put(const LightView& view, const Hull& hull) {
  const float* const points[3] = {hull.along[0], hull.along[1], hull.along[2]};
  GridBox box = kernels_.project(view, points, hull.count, {hull_.x, hull_.y, hull_.z});
  hull_is_on_grid_ = std::none_of(hull_.x, hull_.x + hull.count, [](std::int32_t x) { return x == kOffGrid; });
  if (box.low_x > box.high_x) return box;
  const double off = double{largest(hull)} * kPlaceError, nearer = view.has_place ? double{box.high_z} : 1.0;
  const double margin = off * nearer * view.per_step;
  hull_.count = hull.count;
  hull_.margin = static_cast<float>(margin + 1);
  hull_.margin_z = static_cast<float>(view.has_place ? off * nearer * nearer : off);
  box.low_x = clamped(box.low_x - margin), box.high_x = clamped(box.high_x + margin);
  box.low_y = clamped(box.low_y - margin), box.high_y = clamped(box.high_y + margin);
  return box;
}

GridBox GridCaster::put(const LightView& view, const Caster& surface) {
  return kernels_.project(view, surface.place, surface.vertices, vertices_);
}

// What is nowhere before a plane blocks no point on it, from no point of the light, if the plane rises less than its
// rays; half as much leaves half of the bound (point_vector.h).
std::span<std::uint32_t> GridCaster::find_below(const GridBox& box, const Shaft& shaft, Points& points) {
  const std::size_t count = points.tree().find(kernels_, box, shaft.spread, found_).size();
  const auto found = std::span(found_).first(count);
  if (!hull_is_on_grid_ || found.empty()) return found;
  const Lid lid(hull_);
  const bool lid_is_flat = shaft.spread * lid.tilt() <= kMostRise;
  const auto is_clear = [&](std::uint32_t number) {
    const PointVector& some = points.vectors()[number];
    return (some.active & ~some.blocked) == 0 || (lid_is_flat && !lid.is_before(some, shaft));
  };
  const auto left = std::remove_if(found.begin(), found.end(), is_clear);
  return found.first(kernels_.find_below(hull_, shaft, points.vectors(), found.data(),
                                         static_cast<std::uint32_t>(left - found.begin())));
}

}  // namespace mars::shadow
