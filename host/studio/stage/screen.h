// How a view shows the world, as the renderer and the preview project it, for controls and hands: pixels from the
// picture's top left corner, y down.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "node/wire/film_parts.h"

namespace mars::studio {

struct Ray {
  glm::dvec3 from;
  glm::dvec3 way;  // one length ahead along the camera's axis
};

using Polyline = std::vector<glm::dvec2>;

class Screen {
 public:
  Screen(const wire::Camera& camera, std::uint32_t width, std::uint32_t height);

  // None: nearer than the near plane.
  std::optional<glm::dvec2> pixel_of(const glm::dvec3& place) const;
  // How the pixel moves where the place, which is seen, moves by `by`, a little.
  glm::dvec2 motion_of(const glm::dvec3& place, const glm::dvec3& by) const;
  Ray ray_through(const glm::dvec2& pixel) const;
  // A line through these places, cut where it goes before the near plane.
  std::vector<Polyline> polylines(const std::vector<glm::dvec3>& places) const;
  // The outline of the places' convex hull as it is seen, cut at the near plane, without what the picture does not
  // show: a polygon, whose first point is not repeated; empty where nothing is seen of it.
  Polyline outline(std::span<const glm::dvec3> places) const;
  // Pixels of a length across the axis, as far away as the place; as far as the near plane where it is nearer.
  double scale_at(const glm::dvec3& place) const;
  // A unit vector.
  glm::dvec3 towards_eye(const glm::dvec3& place) const;
  // How far ahead of the eye it is.
  double depth_of(const glm::dvec3& place) const { return to_eye(place).z; }

  bool operator==(const Screen&) const = default;

  const glm::dvec3& right() const { return axes_[0]; }
  const glm::dvec3& up() const { return axes_[1]; }
  glm::dvec3 ahead() const { return -axes_[2]; }
  const glm::dvec3& eye() const { return eye_; }

 private:
  glm::dvec3 to_eye(const glm::dvec3& place) const;  // x right, y up, z ahead
  glm::dvec2 projected(const glm::dvec3& in_eye) const;

  glm::dvec3 axes_[3];
  glm::dvec3 eye_;
  glm::dvec2 size_;
  glm::dvec2 middle_;  // where the view axis is
  double scale_;
  double near_;
  bool parallel_;
};

// Where along the line, in lengths of `way`, it comes nearest to the ray; none where they are as good as parallel.
std::optional<double> nearest_along(const Ray& ray, const glm::dvec3& from, const glm::dvec3& way);

// Where the ray meets the plane; none where it does not.
std::optional<glm::dvec3> on_plane(const Ray& ray, const glm::dvec3& place, const glm::dvec3& normal);

// Counterclockwise as x goes right and y up, from the leftmost; points on its edges are left out (Andrew 1979).
Polyline convex_hull(Polyline points);

// From the pixel to the line, at its nearest.
double distance_to(const Polyline& line, const glm::dvec2& pixel);

}  // namespace mars::studio
