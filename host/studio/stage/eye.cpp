#include "host/studio/stage/eye.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/elementary/elementary.h"

namespace mars::studio {
namespace {

constexpr double kDegreesAPixel = 0.4;    // of turning
constexpr double kGrowthAPixel = 0.0015;  // of the distance

}  // namespace

preview::Orbit chosen_orbit(From from, const preview::Ball& subject, double aspect) {
  if (from == From::side) return preview::orbit_from(preview::From::side, subject, aspect);
  if (from == From::top) return preview::orbit_from(preview::From::top, subject, aspect);
  preview::Orbit orbit = preview::orbit_from(preview::From::front, subject, aspect);
  if (from == From::free) {
    orbit.turn = -35;
    orbit.height = 18;
  }
  return orbit;
}

void show_whole(preview::Orbit& orbit, const preview::Ball& subject, double aspect) {
  const preview::Orbit whole = preview::orbit_from(preview::From::front, subject, aspect);
  orbit.center = whole.center;
  orbit.distance = whole.distance;
}

wire::Camera camera_from(const Eye& eye, double exposure) {
  const bool parallel = eye.from == From::front || eye.from == From::side || eye.from == From::top;
  wire::Camera camera = parallel ? preview::parallel_camera_of(eye.orbit) : preview::camera_of(eye.orbit);
  camera.exposure = exposure;
  return camera;
}

void turn(preview::Orbit& orbit, const glm::dvec2& by) {
  orbit.turn = std::remainder(orbit.turn - kDegreesAPixel * by.x, 360.0);
  orbit.height = std::clamp(orbit.height + kDegreesAPixel * by.y, -90.0, 90.0);
}

void pan(preview::Orbit& orbit, const glm::dvec2& by, double height) {
  const wire::Camera camera = preview::camera_of(orbit);
  const double length = 2 * orbit.distance / (camera.focal * height);  // of a pixel, at the center
  const auto axis = [&](std::size_t row) {
    const auto& m = camera.world_to_eye.m[row];
    return glm::dvec3(m[0], m[1], m[2]);
  };
  orbit.center += length * (by.y * axis(1) - by.x * axis(0));
}

void zoom(preview::Orbit& orbit, const glm::dvec2& by, const glm::dvec2& spot, double height) {
  const double distance = std::clamp(orbit.distance * elementary::exp(kGrowthAPixel * by.y), 1e-6, 1e9);
  pan(orbit, (distance / orbit.distance - 1) * spot, height);
  orbit.distance = distance;
}

}  // namespace mars::studio
