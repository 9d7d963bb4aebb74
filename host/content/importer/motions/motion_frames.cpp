#include "host/content/importer/motions/motion_frames.h"

#include <algorithm>
#include <cmath>

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/rotation.h"
#include "host/content/modeler/frames.h"

namespace mars::importer {
namespace {

constexpr double kSameRate = 2e-4;  // a share: 0.0333333 s are 30 frames a second, 0.0333667 are 29.97
constexpr double kOnAFrame = 1e-6;  // frames of the file
constexpr double kGreatestKind = 30;
constexpr double kWidening = 10;  // limits become multiples of 1/10 degree

glm::dvec3 pose_between(const modeler::Joint& joint, const glm::dvec3& from, const glm::dvec3& to, double part) {
  if (joint.freedoms() < 3) return from + part * (to - from);
  const glm::dmat3 first = modeler::orientation(joint, from);
  const animator::Turn turn = animator::turn_between(first, modeler::orientation(joint, to));
  return animator::pose_of(joint, modeler::rotation(turn.axis, part * turn.angle) * first, from);
}

bool is_ball(const modeler::Joint& joint) {
  const auto whole = [](const modeler::Limits& limits) {
    return !limits.free() || (limits.lower == -180 && limits.upper == 180);
  };
  return joint.freedoms() > 1 && std::ranges::all_of(joint.limits, whole);
}

}  // namespace

double whole_rate(double rate) {
  const double whole = std::round(rate);
  return whole > 0 && std::abs(rate - whole) <= kSameRate * whole ? whole : rate;
}

double kind_rate(double rate) {
  if (rate <= kGreatestKind) return rate;
  for (const double kind : {24.0, 25.0, 30.0})
    if (std::fmod(rate, kind) == 0) return kind;
  return rate;
}

Motion at_rate(std::span<const modeler::Joint> joints, const Motion& motion, double rate) {
  Motion sampled{rate, {}, {}};
  const double step = motion.rate / rate;
  const std::size_t last = motion.poses.size() - 1;
  for (std::size_t frame = 0;; ++frame) {
    double time = double(frame) * step;
    if (std::abs(time - std::round(time)) <= kOnAFrame) time = std::round(time);
    if (time > double(last)) return sampled;
    const auto from = static_cast<std::size_t>(time);
    const double part = time - double(from);
    if (part == 0) {
      sampled.places.push_back(motion.places[from]);
      sampled.poses.push_back(motion.poses[from]);
      continue;
    }
    sampled.places.push_back(motion.places[from] + part * (motion.places[from + 1] - motion.places[from]));
    auto& pose = sampled.poses.emplace_back();
    for (std::size_t i = 0; i < joints.size(); ++i)
      pose.push_back(pose_between(joints[i], motion.poses[from][i], motion.poses[from + 1][i], part));
  }
}

std::vector<std::string> fit_limits(std::vector<modeler::Joint>& joints, Motion& motion) {
  std::vector<std::string> widened;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    modeler::Joint& joint = joints[i];
    const bool ball = is_ball(joint);
    bool wider = false;
    for (auto& poses : motion.poses)
      for (int axis = 0; axis < 3; ++axis) {
        double& angle = poses[i][axis];
        modeler::Limits& limits = joint.limits[axis];
        if (ball && limits.free()) angle = std::remainder(angle, 360);
        if (angle >= limits.lower && angle <= limits.upper) continue;
        wider = true;
        limits.lower = std::min(limits.lower, std::floor(angle * kWidening) / kWidening);
        limits.upper = std::max(limits.upper, std::ceil(angle * kWidening) / kWidening);
      }
    if (wider) widened.push_back(joint.name);
  }
  return widened;
}

}  // namespace mars::importer
