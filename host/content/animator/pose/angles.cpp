#include "host/content/animator/pose/angles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/rotation.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

constexpr double kLocked = 1e-9;  // cosine of the second turn below which the first and third are one turn

double excess(const modeler::Limits& limits, double angle) {
  return std::max({limits.lower - angle, angle - limits.upper, 0.0});
}

// The angle, whole turns more or less: within the limits if it can be, then nearest to `near`.
double fitted(double angle, const modeler::Limits& limits, double near) {
  const double wanted = std::round((near - angle) / 360);
  const double first = std::ceil((limits.lower - kAngleRounding - angle) / 360);
  const double last = std::floor((limits.upper + kAngleRounding - angle) / 360);
  if (first <= last) return angle + 360 * std::clamp(wanted, first, last);
  const double below = angle + 360 * last, above = angle + 360 * first;
  return excess(limits, below) < excess(limits, above) ? below : above;
}

glm::dvec3 fitted(const modeler::Joint& joint, const glm::dvec3& pose, const glm::dvec3& near) {
  glm::dvec3 fit;
  for (int axis = 0; axis < 3; ++axis) fit[axis] = fitted(pose[axis], joint.limits[axis], near[axis]);
  return fit;
}

// The angle about `axis`, a unit vector, that takes `from` to `to` as seen along it.
double angle_about(const glm::dvec3& axis, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 across = glm::cross(axis, from), aim = glm::cross(axis, to);
  return elementary::atan2(glm::dot(axis, glm::cross(across, aim)), glm::dot(across, aim)) / modeler::kDegree;
}

// Which of two poses of one orientation is the better.
bool better(const modeler::Joint& joint, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& near) {
  const double outside_a = largest_excess(joint, a), outside_b = largest_excess(joint, b);
  if (std::max(outside_a, outside_b) > kAngleRounding && std::abs(outside_a - outside_b) > kAngleRounding)
    return outside_a < outside_b;
  return glm::length(a - near) < glm::length(b - near);
}

// The three turns one by one. z stands across both x and y, so Rot(x, a) Rot(y, b) takes it where `turn` does,
// and how far that lies along x gives b.
class Unturned {
 public:
  Unturned(const modeler::Joint& joint, const glm::dmat3& turn) : x_(joint.x_axis), y_(joint.y_axis), turn_(turn) {
    const glm::dvec3 across = glm::cross(x_, y_);
    const double sine_of_axes = glm::length(across), cosine_of_axes = glm::dot(x_, y_);
    z_ = across / sine_of_axes;
    aim_ = turn * z_;
    const glm::dvec3 aside = glm::cross(x_, aim_);
    const double square = glm::dot(aside, aside) - cosine_of_axes * cosine_of_axes;
    cosine_ = std::sqrt(std::max(square, 0.0)) / sine_of_axes;
    second_ = elementary::atan2(glm::dot(x_, aim_) / sine_of_axes, cosine_) / modeler::kDegree;
    locked_ = glm::dot(aside, aside) < kLocked * kLocked;
  }

  double second() const { return second_; }
  bool locked() const { return locked_; }  // x and z turn about the same axis

  glm::dvec3 with_second(double second) const {
    const glm::dvec3 from = modeler::rotation_by_degrees(y_, second) * z_;
    return with_first(angle_about(x_, from, aim_), second);
  }

  glm::dvec3 with_first(double first, double second) const {
    const glm::dmat3 rest =
        modeler::rotation_by_degrees(y_, -second) * modeler::rotation_by_degrees(x_, -first) * turn_;
    return {first, second, angle_about(z_, y_, rest * y_)};
  }

 private:
  glm::dvec3 x_, y_, z_, aim_;
  glm::dmat3 turn_;
  double cosine_, second_;
  bool locked_;
};

// Only the sum (at -90 the difference) of the first and third turn counts: as near as they come, within the limits.
glm::dvec3 locked_pose(const modeler::Joint& joint, const Unturned& turns, const glm::dvec3& near) {
  glm::dvec3 pose = turns.with_first(clamped(joint, near).x, turns.second());
  pose = fitted(joint, pose, near);
  const double third = std::clamp(pose.z, joint.limits[2].lower, joint.limits[2].upper);
  pose.x += (pose.y > 0 ? 1 : -1) * (pose.z - third);
  pose.z = third;
  return fitted(joint, pose, near);
}

}  // namespace

glm::dvec3 excess_of(const modeler::Joint& joint, const glm::dvec3& pose) {
  glm::dvec3 outside;
  for (int axis = 0; axis < 3; ++axis) outside[axis] = excess(joint.limits[axis], pose[axis]);
  return outside;
}

double largest_excess(const modeler::Joint& joint, const glm::dvec3& pose) {
  const glm::dvec3 outside = excess_of(joint, pose);
  return std::max({outside.x, outside.y, outside.z});
}

glm::dvec3 pose_of(const modeler::Joint& joint, const glm::dmat3& turn, const glm::dvec3& near) {
  const Unturned turns(joint, turn);
  if (turns.locked()) return locked_pose(joint, turns, near);
  const glm::dvec3 one = fitted(joint, turns.with_second(turns.second()), near);
  const glm::dvec3 other = fitted(joint, turns.with_second(180 - turns.second()), near);
  return better(joint, other, one, near) ? other : one;
}

glm::dvec3 clamped(const modeler::Joint& joint, const glm::dvec3& pose) {
  glm::dvec3 nearest;
  for (int axis = 0; axis < 3; ++axis)
    nearest[axis] = std::clamp(pose[axis], joint.limits[axis].lower, joint.limits[axis].upper);
  return nearest;
}

}  // namespace mars::animator
