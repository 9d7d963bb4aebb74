#include "host/content/animator/pose/direction.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/rotation.h"
#include "host/content/elementary/elementary.h"

namespace mars::animator {
namespace {

// Where the spline passes through nothing, the key before it.
glm::dvec3 on_spline(const Channel<glm::dvec3>& channel, const Stretch& stretch) {
  const glm::dvec3 direction = spline_at(channel, stretch);
  const double length = glm::length(direction);
  return length < 1e-9 ? channel[stretch.from].value : direction / length;
}

}  // namespace

glm::dvec3 direction_at(const Channel<glm::dvec3>& channel, std::uint32_t frame) {
  const Stretch stretch = stretch_at(channel, frame);
  const glm::dvec3& from = channel[stretch.from].value;
  const glm::dvec3& to = channel[stretch.to].value;
  if (channel[stretch.from].ease.spline && stretch.from != stretch.to) return on_spline(channel, stretch);
  if (from == to) return from;
  const glm::dvec3 across = glm::cross(from, to);
  const double sine = glm::length(across), angle = elementary::atan2(sine, glm::dot(from, to));
  if (angle < 1e-12) return from;
  const glm::dvec3 other = std::abs(from.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 axis = sine > 1e-12 ? across / sine : glm::normalize(glm::cross(from, other));
  return modeler::rotation(axis, stretch.part * angle) * from;
}

}  // namespace mars::animator
