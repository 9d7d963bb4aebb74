#include "host/content/importer/motions/skeleton.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "host/content/modeler/frames.h"

namespace mars::importer {
namespace {

glm::dvec3 across(const glm::dvec3& axis) {
  const glm::dvec3 size = glm::abs(axis);
  const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                           : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                : glm::dvec3(0, 0, 1);
  return glm::normalize(other - glm::dot(other, axis) * axis);
}

}  // namespace

TurnAxes turn_axes(std::span<const glm::dvec3> axes) {
  if (axes.empty()) return {};
  const glm::dvec3& x = axes[0];
  const glm::dvec3 y = axes.size() > 1 ? axes[1] : across(x);
  const bool against = axes.size() > 2 && glm::dot(glm::cross(x, y), axes[2]) < 0;
  return {x, y, against ? -1.0 : 1.0};
}

bool distinct(std::span<const glm::dvec3> axes) {
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(glm::dot(axes[i], axes[j])) > 0.5) return false;
  return true;
}

Skeleton placed(Skeleton skeleton, const glm::dmat3& upright, double factor) {
  for (modeler::Joint& joint : skeleton.joints) {
    joint.place = factor * (upright * joint.place);
    joint.x_axis = upright * joint.x_axis;
    joint.y_axis = upright * joint.y_axis;
  }
  for (auto& ends : skeleton.ends)
    for (glm::dvec3& end : ends) end = factor * (upright * end);
  return skeleton;
}

Motion placed(Motion motion, const glm::dmat3& upright, double factor) {
  for (glm::dvec3& place : motion.places) place = factor * (upright * place);
  return motion;
}

SkeletonBox rest_box(const Skeleton& skeleton) {
  std::vector<glm::dvec3> places;
  SkeletonBox box{skeleton.joints[0].place, skeleton.joints[0].place};
  const auto widen = [&](const glm::dvec3& place) {
    box.min = glm::min(box.min, place);
    box.max = glm::max(box.max, place);
  };
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const modeler::Joint& joint = skeleton.joints[i];
    places.push_back(joint.place + (joint.parent == modeler::kNone ? glm::dvec3(0) : places[joint.parent]));
    widen(places[i]);
    for (const glm::dvec3& end : skeleton.ends[i]) widen(places[i] + end);
  }
  return box;
}

std::vector<glm::dvec3> places_of(const Skeleton& skeleton, const glm::dvec3& place, std::span<const glm::dvec3> pose) {
  std::vector<modeler::Axes> frames;
  std::vector<glm::dvec3> places;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const modeler::Joint& joint = skeleton.joints[i];
    const glm::dmat3 turn = modeler::orientation(joint, pose[i]);
    if (joint.parent == modeler::kNone) {
      frames.push_back({turn, place});
    } else {
      const modeler::Axes& parent = frames[joint.parent];
      frames.push_back({parent.turn * turn, parent.turn * joint.place + parent.place});
    }
    places.push_back(frames.back().place);
  }
  return places;
}

}  // namespace mars::importer
