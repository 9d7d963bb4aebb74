#include "host/content/animator/reading/rig.h"

#include <glm/geometric.hpp>

#include "host/content/animator/pose/camera_points.h"

namespace mars::animator {
namespace {

struct RigLight {
  glm::dvec3 from;  // to the right of the camera's view, ahead of it, up
  glm::dvec3 color;
  double linear;  // intensity in linear films
  double coded;   // and in coded ones
};

constexpr std::array<RigLight, 3> kRig{{{{-0.55, -0.70, 0.75}, {1.00, 0.95, 0.88}, 1.60, 1.25},
                                        {{0.90, -0.50, 0.25}, {0.80, 0.88, 1.00}, 0.45, 0.40},
                                        {{0.45, 0.85, 0.55}, {1.00, 1.00, 1.00}, 0.90, 0.50}}};

glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& otherwise) {
  const double length = glm::length(vector);
  return length < 1e-6 ? otherwise : vector / length;
}

}  // namespace

std::array<glm::dvec3, 3> rig_directions(const glm::dvec3& eye, const glm::dvec3& at, const glm::dvec3& up) {
  const glm::dvec3 above = unit_or(up, {0, 0, 1});
  const glm::dvec3 forward = unit_or(at - eye, {0, 1, 0});
  // A camera that looks along its up vector is refused when the film is compiled.
  const glm::dvec3 right = unit_or(glm::cross(forward, above), {1, 0, 0});
  const glm::dvec3 ahead = glm::cross(above, right);
  std::array<glm::dvec3, 3> directions;
  for (std::size_t i = 0; i < kRig.size(); ++i) {
    const glm::dvec3& from = kRig[i].from;
    directions[i] = glm::normalize(from.x * right + from.y * ahead + from.z * above);
  }
  return directions;
}

std::vector<LightMotion> rig_lights(const Film& film) {
  const auto directions = rig_directions(eye_at(film, 0), at_at(film, 0), value_at(film.camera.up, 0));
  std::vector<LightMotion> lights(kRig.size());
  for (std::size_t i = 0; i < kRig.size(); ++i) {
    lights[i].vector = constant(directions[i]);
    lights[i].color = constant(kRig[i].color);
    lights[i].intensity = constant(film.color == wire::ColorSpace::linear ? kRig[i].linear : kRig[i].coded);
  }
  return lights;
}

Ambient rig_ambient(wire::ColorSpace color) {
  if (color == wire::ColorSpace::coded) return {};
  return {{1.00, 1.00, 1.00}, {0.70, 0.66, 0.62}};
}

}  // namespace mars::animator
