#include "host/studio/stage/eye.h"

#include <gtest/gtest.h>

namespace mars::studio {
namespace {

constexpr double kHeight = 480;

// From the middle of the picture, right and down, where the orbit's camera shows a place of the world.
glm::dvec2 shown(const preview::Orbit& orbit, const glm::dvec3& place) {
  const wire::Camera camera = preview::camera_of(orbit);
  glm::dvec3 eye;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = camera.world_to_eye.m[static_cast<std::size_t>(axis)];
    eye[axis] = row[0] * place.x + row[1] * place.y + row[2] * place.z + row[3];
  }
  return camera.focal * kHeight / 2 / -eye.z * glm::dvec2(eye.x, -eye.y);
}

TEST(Eye, ZoomKeepsWhatIsUnderTheMouse) {
  preview::Orbit orbit{{1, 2, 3}, 30, 20, 8};
  preview::Orbit there = orbit;
  pan(there, {-150, -90}, kHeight);  // its center is what is 150 pixels right of the middle and 90 below
  const glm::dvec2 before = shown(orbit, there.center);
  EXPECT_NEAR(before.x, 150, 1e-9);
  EXPECT_NEAR(before.y, 90, 1e-9);
  zoom(orbit, {0, -240}, {150, 90}, kHeight);
  EXPECT_LT(orbit.distance, 7);
  const glm::dvec2 after = shown(orbit, there.center);
  EXPECT_NEAR(after.x, 150, 1e-9);
  EXPECT_NEAR(after.y, 90, 1e-9);
}

}  // namespace
}  // namespace mars::studio
