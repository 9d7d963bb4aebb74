#include "host/content/animator/pose/camera_points.h"

#include <algorithm>

namespace mars::animator {
namespace {

Key<glm::dvec3> key_in_world(const Key<Point>& key, std::uint32_t frame, JointFrames& frames) {
  Key<glm::dvec3> fixed{key.frame, place_of(key.value, frame, frames), key.ease};
  if (key.in) fixed.in = key.in->offset;
  if (key.out) fixed.out = key.out->offset;
  return fixed;
}

}  // namespace

glm::dvec3 eye_at(const Film& film, std::uint32_t frame) {
  JointFrames frames(film);
  return place_at(film.camera.eye, frame, frames);
}

glm::dvec3 at_at(const Film& film, std::uint32_t frame) {
  JointFrames frames(film);
  return place_at(film.camera.at, frame, frames);
}

glm::dvec3 place_of(const Point& point, std::uint32_t frame, JointFrames& frames) {
  if (point.actor == modeler::kNone) return point.offset;
  const modeler::Axes axes = frames.frame_of(point.actor, point.joint, frame);
  glm::dvec3 place = (point.joint_axes ? axes.turn * point.offset : point.offset) + axes.place;
  if (point.level) place.z = point.offset.z;
  return place;
}

glm::dvec3 place_at(const Channel<Point>& points, std::uint32_t frame, JointFrames& frames) {
  const Stretch stretch = stretch_at(points, frame);
  if (stretch.from == stretch.to) return place_of(points[stretch.from].value, frame, frames);
  // A spline's slopes need a key more on both sides.
  const std::size_t first = stretch.from == 0 ? 0 : stretch.from - 1, end = std::min(stretch.to + 2, points.size());
  Channel<glm::dvec3> fixed;
  for (std::size_t key = first; key < end; ++key) fixed.push_back(key_in_world(points[key], frame, frames));
  return value_at(fixed, frame);
}

bool follows(const Channel<Point>& points) {
  return std::ranges::any_of(points, [](const Key<Point>& key) { return key.value.actor != modeler::kNone; });
}

}  // namespace mars::animator
