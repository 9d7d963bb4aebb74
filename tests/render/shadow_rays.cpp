#include "tests/render/shadow_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mars::test {

using shape::cross;
using shape::dot;
using shape::length;
using shape::operator-;
using shape::Vec3;

namespace {

constexpr double kSteps = 2;  // from edges

Vec3 vector_of(const float* a) { return {a[0], a[1], a[2]}; }

// What a light sees: across along x and y, along its axis z; from its place if it has one.
class Looking {
 public:
  explicit Looking(const shadow::LightView& view)
      : u_(vector_of(view.u)), v_(vector_of(view.v)), axis_(vector_of(view.axis)), place_(vector_of(view.place)) {}
  Vec3 at(const Vec3& place) const {
    const Vec3 from = place - place_;
    return {dot(u_, from), dot(v_, from), dot(axis_, from)};
  }

 private:
  Vec3 u_, v_, axis_, place_;
};

// One ray, to the point `at`.
struct Ray {
  const shadow::LightView& view;
  Vec3 at;
  double e;

  bool has_place() const { return view.has_place != 0; }
  double steps() const { return double{view.per_step}; }
  // Homogeneous places across.
  Vec3 across(const Vec3& p) const { return {p[0], p[1], has_place() ? p[2] : 1.0}; }
  double nearness(const Vec3& p) const { return has_place() ? 1 / p[2] : p[2]; }
};

// How far the ray is inside the triangle, grid steps; negative: outside.
double depth_inside(const Ray& ray, const std::array<Vec3, 3>& t) {
  const Vec3 point = ray.across(ray.at);
  double sum = 0, least = std::numeric_limits<double>::max();
  Vec3 lines[3];
  for (std::size_t k = 0; k < 3; ++k) {
    lines[k] = cross(ray.across(t[k]), ray.across(t[(k + 1) % 3]));
    sum += dot(lines[k], point);
  }
  for (const Vec3& line : lines) {
    const double far = dot(line, point) / point[2] / std::hypot(line[0], line[1]);
    least = std::min(least, sum < 0 ? -far : far);
  }
  return std::isfinite(least) ? least * ray.steps() : 0;
}

// How the triangle's plane runs over the view: nearness there, and how much it changes across.
struct Slope {
  double there, change;
};

Slope slope_of(const Ray& ray, const std::array<Vec3, 3>& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  if (ray.has_place()) {
    const double c = dot(n, t[0]);
    const Vec3 way{ray.at[0] / ray.at[2], ray.at[1] / ray.at[2], 1};
    return {dot(n, way) / c, (std::abs(n[0]) + std::abs(n[1])) / std::abs(c)};
  }
  return {ray.at[2] + dot(n, t[0] - ray.at) / n[2], (std::abs(n[0]) + std::abs(n[1])) / std::abs(n[2])};
}

Sight trace_triangle(const Ray& ray, const std::array<Vec3, 3>& t) {
  const double inside = depth_inside(ray, t);
  if (inside < -kSteps) return Sight::open;
  const Slope slope = slope_of(ray, t);
  if (ray.has_place() && !(slope.there > 0)) return std::isnan(slope.there) ? Sight::unsure : Sight::open;
  const double before = slope.there - ray.nearness(ray.at);
  const double z = ray.has_place() ? 1 / ray.at[2] : 1.0;
  const double step = (ray.has_place() ? ray.at[2] : 1.0) / ray.steps();
  // Of a length in the world, on the view.
  const auto bound = [&](double e) { return e * z * slope.change + e * (ray.has_place() ? z * z : 1.0); };
  if (before < 0.5 * bound(ray.e - kSteps * step)) return Sight::open;
  if (ray.has_place() && 1 / slope.there < double{ray.view.nearest} * 0.999) return Sight::open;
  const bool sure = inside > kSteps && before > 1.5 * bound(ray.e + kSteps * step) &&
                    (!ray.has_place() || 1 / slope.there > double{ray.view.nearest} * 1.001);
  return sure ? Sight::blocked : Sight::unsure;
}

}  // namespace

ShadowRays::ShadowRays(std::span<const CastingSurface> surfaces) {
  for (const CastingSurface& surface : surfaces) {
    Body body{{}, 0, surface.triangles};
    const double share = 1.0 / (3.0 * static_cast<double>(surface.triangles.size()));
    for (const auto& t : surface.triangles)
      for (const Vec3& corner : t)
        for (std::size_t k = 0; k < 3; ++k) body.middle[k] += corner[k] * share;
    for (const auto& t : surface.triangles)
      for (const Vec3& corner : t) body.radius = std::max(body.radius, length(corner - body.middle));
    bodies_.push_back(body);
  }
}

Sight ShadowRays::trace(const shadow::LightView& view, const shadow::PointFrame& frame, const Vec3& place,
                        double w) const {
  const Looking looking(view);
  Ray ray{view, looking.at(place), (w * double{frame.by_square} + double{frame.by_w}) * w + double{frame.everywhere}};
  if (ray.has_place()) {
    if (ray.at[2] < double{view.nearest} * 0.999) return Sight::open;
    ray.e += ray.at[2] * double{frame.by_depth};
  }
  // The way from the point to the light.
  const Vec3 to_light = ray.has_place() ? vector_of(view.place) - place : cross(vector_of(view.u), vector_of(view.v));
  const double far = length(to_light);
  Sight sight = Sight::open;
  for (const Body& body : bodies_) {
    const Vec3 from = body.middle - place;
    const double away = length(cross(to_light, from)) / far;
    if (away > body.radius * 1.01 + 10 * ray.e) continue;
    for (const auto& triangle : body.triangles) {
      const Vec3 corner = triangle[0] - place;
      const double reach = std::max(length(triangle[1] - triangle[0]), length(triangle[2] - triangle[0]));
      if (length(cross(to_light, corner)) > (reach * 1.01 + 10 * ray.e) * far) continue;
      const Sight here =
          trace_triangle(ray, {looking.at(triangle[0]), looking.at(triangle[1]), looking.at(triangle[2])});
      if (here == Sight::blocked) return here;
      if (here == Sight::unsure) sight = here;
    }
  }
  return sight;
}

}  // namespace mars::test
