#include "host/modeler/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "host/modeler/teapot.h"
#include "tests/host/modeler/surface.h"

namespace mars::host {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kArcError = 4.3e-6;  // of a radius, by one 45 degree arc

struct Solid {
  const char* name;
  std::vector<node::Patch> patches;
  double volume;
};

std::vector<Solid> solids() {
  return {{"box", make_box(), 1},
          {"sphere", make_sphere(), kPi / 6},
          {"cylinder", make_cylinder(), kPi / 4},
          {"cone", make_cone(0), kPi / 12},
          {"blunt cone", make_cone(0.5), kPi / 12 * 1.75},
          {"torus", make_torus(0.125), 2 * kPi * 0.375 * kPi * 0.125 * 0.5},
          {"thin torus", make_torus(0.01), 2 * kPi * 0.49 * kPi * 0.01 * 0.5}};
}

TEST(Primitives, AreClosedBitForBit) {
  for (const Solid& solid : solids())
    for (const auto& [edge, use] : edge_uses(solid.patches)) {
      EXPECT_EQ(use.forward, 1) << solid.name;
      EXPECT_EQ(use.backward, 1) << solid.name;
    }
}

TEST(Primitives, HaveTheirVolumeWithTheOutsideOut) {
  for (const Solid& solid : solids()) EXPECT_NEAR(volume_of(solid.patches), solid.volume, 1e-3) << solid.name;
}

TEST(Primitives, FillTheUnitCube) {
  for (const Solid& solid : solids())
    for (int axis = 0; axis < 3; ++axis) {
      float least = 1, greatest = 0;
      for (const node::Patch& patch : solid.patches)
        for (const auto& point : patch.points) {
          least = std::min(least, point[axis]);
          greatest = std::max(greatest, point[axis]);
        }
      EXPECT_EQ(least, 0.0f) << solid.name;
      EXPECT_EQ(greatest, 1.0f) << solid.name;
    }
}

// The largest distance of `off` over points of all patches.
double farthest(const std::vector<node::Patch>& patches,
                const std::function<double(const glm::dvec3&)>& off) {
  double most = 0;
  for (const node::Patch& patch : patches)
    for (int j = 0; j <= 20; ++j)
      for (int i = 0; i <= 20; ++i)
        most = std::max(most, std::abs(off(point_of(patch, i / 20.0, j / 20.0) - glm::dvec3(0.5))));
  return most;
}

TEST(Primitives, LieOnTheTrueSurface) {
  const auto radius = [](const glm::dvec3& p) { return std::hypot(p.x, p.y); };
  const double arc = 0.5 * kArcError + 1e-7;
  EXPECT_LT(farthest(make_sphere(), [](const glm::dvec3& p) { return glm::length(p) - 0.5; }), 2 * arc);
  const auto off_cylinder = [&](const glm::dvec3& p) { return std::max(radius(p), std::abs(p.z)) - 0.5; };
  EXPECT_LT(farthest(make_cylinder(), off_cylinder), arc);
  const auto off_cone = [&](const glm::dvec3& p) {
    return p.z < -0.4999 ? 0 : radius(p) - 0.5 * (0.5 - p.z);
  };
  EXPECT_LT(farthest(make_cone(0), off_cone), arc);
  const auto off_torus = [&](const glm::dvec3& p) {
    return std::hypot((radius(p) - 0.375) / 0.125, p.z / 0.5) - 1;
  };
  // The ring's error, of its outer radius, counts four times in units of the tube.
  EXPECT_LT(farthest(make_torus(0.125), off_torus), 5 * kArcError + 1e-6);
}

TEST(Primitives, NormalsOfTheSpherePointAway) {
  for (const node::Patch& patch : make_sphere())
    for (const double u : {0.1, 0.5, 0.9})
      for (const double v : {0.1, 0.5, 0.9}) {
        const glm::dvec3 normal = glm::normalize(normal_of(patch, u, v));
        EXPECT_GT(glm::dot(normal, glm::normalize(point_of(patch, u, v) - glm::dvec3(0.5))), 0.99999);
      }
}

TEST(Teapot, HasNewellsPatchesWithinItsBounds) {
  const auto patches = make_teapot(1);
  ASSERT_EQ(patches.size(), 32u);
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = kTeapotBounds.max[axis] - kTeapotBounds.min[axis];
    EXPECT_NEAR(kTeapotBounds.min[axis] + extent * patches[0].points[0][axis],
                (axis == 0   ? 1.4
                 : axis == 1 ? 0
                             : 2.4),
                1e-6);
  }
}

TEST(Teapot, LidsTipIsCollapsed) {
  const auto patches = make_teapot(1.077);
  for (std::size_t patch = 20; patch < 24; ++patch) EXPECT_TRUE(collapsed(sides_of(patches[patch])[0]));
  for (std::size_t patch = 28; patch < 32; ++patch) EXPECT_TRUE(collapsed(sides_of(patches[patch])[0]));
}

TEST(Teapot, OpensOnlyAtTheRimTheLidAndWhereHandleAndSpoutEnd) {
  int open = 0;
  for (const auto& [edge, use] : edge_uses(make_teapot(1.077))) {
    EXPECT_LE(use.forward, 1);
    EXPECT_LE(use.backward, 1) << "neighbours have the same outside";
    open += use.forward + use.backward == 1;
  }
  EXPECT_EQ(open, 4 + 4 + 2 * 2 + 2 * 2);  // inside of the rim, lid, both ends of the handle, of the spout
  EXPECT_GT(volume_of(make_teapot(1.077)), 0);
}

TEST(Teapot, TheLidCanMeetTheRim) {
  const auto edge_radius = [](double lid) {
    const double x = make_teapot(lid)[24].points[12][0];
    return kTeapotBounds.min.x + x * (kTeapotBounds.max.x - kTeapotBounds.min.x);
  };
  EXPECT_NEAR(edge_radius(1), 1.3, 1e-6);
  EXPECT_NEAR(edge_radius(1.077), 1.4001, 1e-6);
}

}  // namespace
}  // namespace mars::host
