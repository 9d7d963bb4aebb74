#include "host/content/animator/pose/rotation.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "host/content/elementary/elementary.h"

namespace mars::animator {
namespace {

constexpr double kNothing = 1e-14;   // radians: less is rounding
constexpr double kHalfTurn = 1e-12;  // sine below which the sign of a half turn's axis is rounding

int largest(const glm::dvec3& vector) {
  const glm::dvec3 size = glm::abs(vector);
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

// From n n^T, which R + R^T holds beside the identity: well-conditioned where the sine is not.
glm::dvec3 axis_near_half_turn(const glm::dmat3& turn, const glm::dvec3& sine_axis, double cosine) {
  const glm::dmat3 square = (0.5 * (turn + glm::transpose(turn)) - cosine * glm::dmat3(1)) / (1 - cosine);
  const int column = largest({square[0][0], square[1][1], square[2][2]});
  const glm::dvec3 axis = glm::normalize(square[column]);
  if (glm::length(sine_axis) > kHalfTurn) return glm::dot(axis, sine_axis) < 0 ? -axis : axis;
  return axis[largest(axis)] < 0 ? -axis : axis;
}

}  // namespace

Turn turn_between(const glm::dmat3& first, const glm::dmat3& last) {
  const glm::dmat3 turn = last * glm::transpose(first);
  const glm::dmat3 skew = 0.5 * (turn - glm::transpose(turn));
  const glm::dvec3 sine_axis(skew[1][2], skew[2][0], skew[0][1]);
  const double cosine = (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2;
  const double sine = glm::length(sine_axis);
  const double angle = elementary::atan2(sine, cosine);
  if (angle < kNothing) return {{1, 0, 0}, 0};
  if (cosine < -0.5) return {axis_near_half_turn(turn, sine_axis, elementary::cos(angle)), angle};
  return {sine_axis / sine, angle};
}

}  // namespace mars::animator
