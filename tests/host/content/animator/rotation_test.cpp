// Turns between orientations, with quaternion slerp as the oracle.
#include "host/content/animator/pose/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

namespace mars::animator {
namespace {

constexpr double kPi = 3.14159265358979323846;

double turn_difference(const glm::dmat3& a, const glm::dmat3& b) {
  double most = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) most = std::max(most, std::abs(a[column][row] - b[column][row]));
  return most;
}

std::vector<glm::dvec3> axes() {
  std::vector<glm::dvec3> axes;
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0})
        if (x != 0 || y != 0 || z != 0) axes.push_back(glm::normalize(glm::dvec3(x, y, z)));
  axes.push_back(glm::normalize(glm::dvec3(1, 1e-5, -1e-9)));
  return axes;
}

TEST(Rotation, IsTheQuaternions) {
  for (const glm::dvec3& axis : axes())
    for (const double angle : {-3.0, -1e-9, 0.0, 0.1, 1.0, 3.1, 7.0})
      EXPECT_LT(turn_difference(modeler::rotation(axis, angle), glm::mat3_cast(glm::angleAxis(angle, axis))), 1e-14);
}

TEST(Rotation, QuarterTurnsAreExact) {
  const glm::dmat3 quarter(0, 1, 0, -1, 0, 0, 0, 0, 1);
  for (const double turns : {0.0, 1.0, -7.0, 400.0})
    EXPECT_EQ(modeler::rotation_by_degrees({0, 0, 1}, 90 + 360 * turns), quarter);
  EXPECT_EQ(modeler::rotation_by_degrees(glm::normalize(glm::dvec3(1, 2, 3)), 720), glm::dmat3(1));
}

TEST(TurnBetween, FollowsSlerp) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&] {
      return glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
    };
    const glm::dquat first = any(), last = any();
    const glm::dmat3 start = glm::mat3_cast(first);
    const Turn turn = turn_between(start, glm::mat3_cast(last));
    for (const double part : {0.0, 0.25, 0.5, 0.9, 1.0})
      EXPECT_LT(turn_difference(modeler::rotation(turn.axis, part * turn.angle) * start,
                                glm::mat3_cast(glm::slerp(first, last, part))),
                1e-11 / std::max(1e-6, kPi - turn.angle));
  }
}

TEST(TurnBetween, NothingTurnsAtZero) {
  for (const glm::dvec3& axis : axes()) {
    const glm::dmat3 any = modeler::rotation(axis, 0.7);
    EXPECT_EQ(turn_between(any, any).angle, 0) << "the product with the transpose is not the identity to the bit";
  }
}

TEST(TurnBetween, SmallAnglesKeepTheirAxis) {
  for (const glm::dvec3& axis : axes())
    for (const double angle : {1e-2, 1e-5, 1e-8, 1e-11}) {
      const Turn turn = turn_between(glm::dmat3(1), modeler::rotation(axis, angle));
      EXPECT_NEAR(turn.angle / angle, 1, 1e-9);
      EXPECT_LT(glm::length(turn.axis - axis), 1e-9);
    }
}

// Near half a turn slerp itself is the poorer one, so the turn is held against what made it.
TEST(TurnBetween, NearHalfATurnKeepsAxisAndAngle) {
  for (const glm::dvec3& axis : axes())
    for (const double less : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9}) {
      const glm::dmat3 start = modeler::rotation({0.6, 0, 0.8}, 0.3),
                       last = modeler::rotation(axis, kPi - less) * start;
      const Turn turn = turn_between(start, last);
      EXPECT_NEAR(turn.angle, kPi - less, 1e-13);
      EXPECT_LT(glm::length(turn.axis - axis), 1e-6) << less;
      EXPECT_LT(turn_difference(modeler::rotation(turn.axis, turn.angle) * start, last), 1e-13);
      EXPECT_LT(turn_difference(modeler::rotation(turn.axis, turn.angle / 2) * start,
                                modeler::rotation(axis, (kPi - less) / 2) * start),
                1e-6);
    }
}

TEST(TurnBetween, HalfATurnGoesAboutTheAxisWithItsLargestComponentPositive) {
  for (const glm::dvec3& axis : axes()) {
    const glm::dmat3 last = 2.0 * glm::outerProduct(axis, axis) - glm::dmat3(1);  // to the bit as good as it gets
    const Turn turn = turn_between(glm::dmat3(1), last);
    EXPECT_NEAR(turn.angle, kPi, 1e-12);
    const glm::dvec3 size = glm::abs(turn.axis);
    const double largest = std::max({size.x, size.y, size.z});
    EXPECT_GT(std::max({turn.axis.x, turn.axis.y, turn.axis.z}), largest - 1e-9) << "of " << axis.x << axis.y << axis.z;
    EXPECT_LT(turn_difference(modeler::rotation(turn.axis, turn.angle), last), 1e-12);
    const glm::dquat half = glm::angleAxis(kPi / 2, glm::dot(turn.axis, axis) > 0 ? axis : -axis);
    EXPECT_LT(turn_difference(modeler::rotation(turn.axis, turn.angle / 2), glm::mat3_cast(half)), 1e-12);
  }
}

}  // namespace
}  // namespace mars::animator
