#include "host/studio/stage/screen.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace mars::studio {

Screen::Screen(const wire::Camera& camera, std::uint32_t width, std::uint32_t height)
    : eye_(0),
      size_(width, height),
      middle_((0.5 - camera.shift_x) * width, (0.5 + camera.shift_y) * height),
      scale_(camera.focal * height / 2),
      near_(camera.near),
      parallel_(camera.projection == wire::Projection::orthographic) {
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& m = camera.world_to_eye.m[row];
    axes_[row] = {m[0], m[1], m[2]};
    eye_ -= m[3] * axes_[row];
  }
}

glm::dvec3 Screen::to_eye(const glm::dvec3& place) const {
  const glm::dvec3 from = place - eye_;
  return {glm::dot(axes_[0], from), glm::dot(axes_[1], from), -glm::dot(axes_[2], from)};
}

glm::dvec2 Screen::projected(const glm::dvec3& in_eye) const {
  return middle_ + scale_ / (parallel_ ? 1 : in_eye.z) * glm::dvec2(in_eye.x, -in_eye.y);
}

std::optional<glm::dvec2> Screen::pixel_of(const glm::dvec3& place) const {
  const glm::dvec3 in_eye = to_eye(place);
  if (in_eye.z < near_) return std::nullopt;
  return projected(in_eye);
}

glm::dvec2 Screen::motion_of(const glm::dvec3& place, const glm::dvec3& by) const {
  const glm::dvec3 at = to_eye(place), step = to_eye(eye_ + by);
  if (parallel_) return scale_ * glm::dvec2(step.x, -step.y);
  const double x = (step.x - at.x * step.z / at.z) / at.z, y = (step.y - at.y * step.z / at.z) / at.z;
  return scale_ * glm::dvec2(x, -y);
}

Ray Screen::ray_through(const glm::dvec2& pixel) const {
  const glm::dvec2 across = (pixel - middle_) / scale_;
  const glm::dvec3 in_plane = across.x * axes_[0] - across.y * axes_[1];
  return parallel_ ? Ray{eye_ + in_plane, ahead()} : Ray{eye_, in_plane + ahead()};
}

std::vector<Polyline> Screen::polylines(const std::vector<glm::dvec3>& places) const {
  std::vector<Polyline> lines;
  glm::dvec3 before{};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::dvec3 at = to_eye(places[i]);
    const bool seen = at.z >= near_, was_seen = i > 0 && before.z >= near_;
    const auto crossing = [&] { return projected(before + (near_ - before.z) / (at.z - before.z) * (at - before)); };
    if (seen && !was_seen) {
      lines.emplace_back();
      if (i > 0) lines.back().push_back(crossing());
    }
    if (seen) lines.back().push_back(projected(at));
    if (!seen && was_seen) lines.back().push_back(crossing());
    before = at;
  }
  return lines;
}

Polyline Screen::outline(std::span<const glm::dvec3> places) const {
  std::vector<glm::dvec3> seen, behind;
  for (const glm::dvec3& place : places) {
    const glm::dvec3 at = to_eye(place);
    (at.z >= near_ ? seen : behind).push_back(at);
  }
  Polyline pixels;
  for (const glm::dvec3& at : seen) {
    pixels.push_back(projected(at));
    for (const glm::dvec3& other : behind)
      pixels.push_back(projected(at + (near_ - at.z) / (other.z - at.z) * (other - at)));
  }
  const auto beside = [&](int axis) {
    const auto all = [&](const auto& is) { return std::all_of(pixels.begin(), pixels.end(), is); };
    return all([&](const glm::dvec2& pixel) { return pixel[axis] < 0; }) ||
           all([&](const glm::dvec2& pixel) { return pixel[axis] > size_[axis]; });
  };
  if (beside(0) || beside(1)) return {};
  return convex_hull(std::move(pixels));
}

double Screen::scale_at(const glm::dvec3& place) const {
  return parallel_ ? scale_ : scale_ / std::max(to_eye(place).z, near_);
}

glm::dvec3 Screen::towards_eye(const glm::dvec3& place) const {
  return parallel_ ? axes_[2] : glm::normalize(eye_ - place);
}

std::optional<double> nearest_along(const Ray& ray, const glm::dvec3& from, const glm::dvec3& way) {
  const glm::dvec3 between = from - ray.from;
  const double a = glm::dot(way, way), b = glm::dot(way, ray.way), c = glm::dot(ray.way, ray.way);
  const double determinant = a * c - b * b;
  if (determinant < 1e-6 * a * c) return std::nullopt;
  return (b * glm::dot(ray.way, between) - c * glm::dot(way, between)) / determinant;
}

std::optional<glm::dvec3> on_plane(const Ray& ray, const glm::dvec3& place, const glm::dvec3& normal) {
  const double along = glm::dot(ray.way, normal);
  if (std::abs(along) < 1e-9) return std::nullopt;
  const double part = glm::dot(place - ray.from, normal) / along;
  if (part <= 0) return std::nullopt;
  return ray.from + part * ray.way;
}

Polyline convex_hull(Polyline points) {
  const auto before = [](const glm::dvec2& one, const glm::dvec2& two) {
    return one.x < two.x || (one.x == two.x && one.y < two.y);
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polyline hull;
  const auto add = [&](const glm::dvec2& point, std::size_t fixed) {
    const auto turns_left = [&] {
      const glm::dvec2 edge = hull.back() - hull[hull.size() - 2], on = point - hull.back();
      return edge.x * on.y - edge.y * on.x > 0;
    };
    while (hull.size() > fixed && !turns_left()) hull.pop_back();
    hull.push_back(point);
  };
  for (const glm::dvec2& point : points) add(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

double distance_to(const Polyline& line, const glm::dvec2& pixel) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::dvec2 from = line[i], way = line[std::min(i + 1, line.size() - 1)] - from;
    const double length = glm::dot(way, way);
    const double part = length > 0 ? std::clamp(glm::dot(pixel - from, way) / length, 0.0, 1.0) : 0;
    least = std::min(least, glm::length(pixel - from - part * way));
  }
  return least;
}

}  // namespace mars::studio
