#include "host/content/importer/joint_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace mars::importer {
namespace {

constexpr double kLeastSine = 1e-3;  // as between a model's axes
constexpr double kNoise = 1e-6;      // that single precision leaves of zeros
constexpr double kEven = 1e-3;       // what single precision leaves of an even scale, and more

// The numbers of a rotation in single precision have not more digits; those of a turn by 90 degrees become whole.
glm::dvec3 rounded(glm::dvec3 axis) {
  for (int i = 0; i < 3; ++i) axis[i] = std::round(axis[i] * 1e6) / 1e6 + 0.0;
  return axis;
}

}  // namespace

glm::dmat3 JointFrame::axes() const {
  const glm::dvec3 x = glm::normalize(x_axis), y = glm::normalize(y_axis);
  return {x, y, glm::cross(x, y)};
}

JointFrame frame_of(const glm::dmat4& matrix) {
  JointFrame frame{glm::dvec3(matrix[3])};
  const glm::dvec3 x(matrix[0]), y(matrix[1]);
  const double sine = glm::length(glm::cross(x, y)) / (glm::length(x) * glm::length(y));
  if (!(sine > kLeastSine)) return frame;
  frame.x_axis = rounded(glm::normalize(x));
  const glm::dvec3 unit_x = glm::normalize(frame.x_axis);
  frame.y_axis = rounded(glm::normalize(y - unit_x * glm::dot(unit_x, y)));
  return frame;
}

glm::dmat3 within_frame(const JointFrame& frame, const glm::dmat3& linear) {
  glm::dmat3 within = glm::inverse(frame.axes()) * linear;
  double greatest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) greatest = std::max(greatest, std::abs(within[column][row]));
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (std::abs(within[column][row]) < kNoise * greatest) within[column][row] = 0;
  return within;
}

bool scales_evenly(const glm::dmat4& matrix) {
  const glm::dvec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
  const double square = glm::dot(x, x);
  const auto nearly_zero = [&](double number) { return std::abs(number) <= kEven * square; };
  return nearly_zero(glm::dot(y, y) - square) && nearly_zero(glm::dot(z, z) - square) && nearly_zero(glm::dot(x, y)) &&
         nearly_zero(glm::dot(x, z)) && nearly_zero(glm::dot(y, z));
}

}  // namespace mars::importer
