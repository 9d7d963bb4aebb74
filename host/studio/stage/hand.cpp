#include "host/studio/stage/hand.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/axis_turn.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"
#include "host/studio/stage/hand_words.h"
#include "host/studio/stage/selection.h"

namespace mars::studio {
namespace {

constexpr double kEdgeOn = 0.12;       // cosine between a ring's axis and the way to the eye: it is seen as a line
constexpr double kLeastExtent = 1e-3;  // of a box, of its extent before

glm::dmat3 linear_of(const wire::Matrix& matrix) {
  const auto& m = matrix.m;
  return {m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2]};
}

}  // namespace

Hand::Hand(const Project& project, const Selection& selection, const Screen& screen, const glm::dvec2& mouse)
    : project_(project), selection_(selection), mouse_(screen, mouse) {}

void Hand::take(const Grip& grip, RingAxes axes) {
  grip_ = grip;
  posed_ = posed(project_, selection_).value();
  pose_ = posed_.pose;
  axes_ = axes;
  if (grip.what == Grip::What::ring)
    for (const std::size_t joint : selection_.more) take_along(joint);
  const animator::ActorState state = animator::state_at(project_.film(), *selection_.actor, project_.frame());
  if (grip.what == Grip::What::arrow || grip.what == Grip::What::plane) {
    const bool of_joint = project_.is_model();
    world_ = of_joint ? posed_.center : state.place;
    place_ = of_joint ? posed_.joint->place : state.place;
  }
  if (grip.what == Grip::What::face) {
    frame_ = segment_frame_of(project_, selection_).value();
    sbb_ = project_.film().model_of(*selection_.actor).joints[*selection_.joint].segment->sbb;
    glm::dvec3 middle = 0.5 * (sbb_.min + sbb_.max);
    middle[grip.axis] = grip.side == 0 ? sbb_.min[grip.axis] : sbb_.max[grip.axis];
    world_ = frame_.turn * middle + frame_.place;
  }
  if (grip.what == Grip::What::point) {
    const modeler::Model& model = project_.film().model_of(*selection_.actor);
    matrix_ = matrix_of_point(model, *selection_.joint, state, grip);
    const auto& patch = model.shapes[model.joints[*selection_.joint].segment->shape].patches[grip.patch];
    const auto& point = patch.points[4 * grip.j + grip.i];
    place_ = {point[0], point[1], point[2]};
    world_ = linear_of(matrix_) * place_ + glm::dvec3(matrix_.m[0][3], matrix_.m[1][3], matrix_.m[2][3]);
  }
}

// A joint that has no ring about the axis stays.
void Hand::take_along(std::size_t joint) {
  const Posed posed = studio::posed(project_, {selection_.actor, joint}).value();
  if (has_ring(*posed.joint, grip_->axis, axes_)) along_.push_back({posed.joint->name, posed, posed.pose});
}

bool Hand::take(const Hit& hit) {
  const std::size_t joint = turning_joint(project_.film().model_of(*selection_.actor), *selection_.joint);
  if (joint == modeler::kNone) return false;
  selection_.joint = joint;
  const auto posed = studio::posed(project_, selection_);
  if (!posed) return false;
  posed_ = *posed;
  pose_ = posed_.pose;
  const glm::dmat3 turn = posed_.parent.turn * modeler::orientation(*posed_.joint, posed_.pose);
  held_ = Held{joint, glm::transpose(turn) * (hit.place - posed_.center)};
  return true;
}

std::optional<Json> Hand::follow(const glm::dvec2& mouse, bool shift) {
  const bool point = grip_ && grip_->what == Grip::What::point;
  const glm::dvec2 before = mouse_.at();
  mouse_.follow(mouse, shift && !point);
  if (held_) return follow_limb();
  if (!grip_) return std::nullopt;
  switch (grip_->what) {
    case Grip::What::ring: wound_ += turned_by(before, mouse_.at()); return follow_ring();
    case Grip::What::arrow:
    case Grip::What::plane: return follow_place();
    case Grip::What::face: return follow_face();
    case Grip::What::point: return follow_point(shift);
    case Grip::What::size: break;  // of marks
  }
  return std::nullopt;
}

const std::string& Hand::actor_name() const { return project_.film().actors[*selection_.actor].name; }

const std::string& Hand::joint_name() const {
  return project_.film().model_of(*selection_.actor).joints[*selection_.joint].name;
}

// Turns the joint and those along with the joint, or the actor as a whole.
Json Hand::turn_step(const glm::dvec3& turn) const {
  if (!selection_.joint) {
    refuse_carried(project_, *selection_.actor);
    return pose_step(project_, actor_name(), {"turn=" + shown_numbers(turn)});
  }
  std::map<std::string, glm::dvec3> turns{{joint_name(), turn}};
  for (const TurnedAlong& each : along_) turns[each.name] = each.pose;
  if (project_.is_model()) return posed_model(turns);
  std::vector<std::string> settings;
  for (const auto& [joint, pose] : turns) settings.push_back(joint_setting(joint, pose));
  return pose_step(project_, actor_name(), settings);
}

// Degrees about the ring's axis, by the mouse's way round its center; where the ring is seen from its edge, by the way
// along it.
double Hand::turned_by(const glm::dvec2& before, const glm::dvec2& now) const {
  const TurnAxis axis = posed_.axis(grip_->axis, ring_axes_of(*posed_.joint, axes_));
  const auto center = mouse_.screen().pixel_of(axis.center);
  if (!center) return 0;
  const glm::dvec3 to_eye = mouse_.screen().towards_eye(axis.center);
  const double facing = glm::dot(axis.axis, to_eye);
  if (std::abs(facing) < kEdgeOn) {
    const glm::dvec2 way = mouse_.screen().motion_of(axis.center, glm::cross(axis.axis, to_eye));
    return glm::dot(now - before, glm::normalize(way)) / ring_pixels(grip_->axis) / modeler::kDegree;
  }
  const glm::dvec2 from = before - *center, to = now - *center;
  const double angle = elementary::atan2(from.x * to.y - from.y * to.x, glm::dot(from, to)) / modeler::kDegree;
  return facing > 0 ? -angle : angle;  // y is down
}

// About another axis than a number's the turn is what the mouse asks for, held within the limits number by number.
glm::dvec3 Hand::wound(const Posed& posed, const glm::dvec3& near) const {
  if (const RingAxes axes = ring_axes_of(*posed.joint, axes_); axes != RingAxes::numbers) {
    const glm::dvec3 axis = glm::transpose(posed.parent.turn) * posed.axis(grip_->axis, axes).axis;
    const animator::Turned turned = animator::turned_about(*posed.joint, posed.pose, axis, wound_, near);
    return animator::clamped(*posed.joint, turned.pose);
  }
  glm::dvec3 pose = posed.pose;
  const modeler::Limits& limits = posed.joint->limits[static_cast<std::size_t>(grip_->axis)];
  pose[grip_->axis] = std::clamp(pose[grip_->axis] + wound_, limits.lower, limits.upper);
  return pose;
}

std::optional<Json> Hand::follow_ring() {
  pose_ = wound(posed_, pose_);
  for (TurnedAlong& each : along_) each.pose = wound(each.posed, each.pose);
  return turn_step(pose_);
}

std::optional<Json> Hand::follow_limb() {
  pose_ = pose_towards(posed_, held_->place, pose_, mouse_.screen(), mouse_.at());
  return turn_step(pose_);
}

std::optional<Json> Hand::follow_place() {
  const bool of_joint = project_.is_model();
  glm::dvec3 way(0);
  way[grip_->axis] = 1;
  if (of_joint) way = posed_.parent.turn * way;
  const auto by = grip_->what == Grip::What::plane ? mouse_.across(world_) : mouse_.along(world_, way);
  if (!by) return std::nullopt;
  const glm::dvec3 place = place_ + (of_joint ? glm::transpose(posed_.parent.turn) * *by : *by);
  if (!of_joint) {
    refuse_carried(project_, *selection_.actor);
    return pose_step(project_, actor_name(), {"place=" + shown_numbers(place)});
  }
  std::vector<std::string> options;
  add_option(options, "--place", {place.x, place.y, place.z});
  return joint_step("set", joint_name(), options);
}

// The face opposite stays.
std::optional<Json> Hand::follow_face() {
  const int axis = grip_->axis;
  const glm::dvec3 way = frame_.turn[axis];
  const auto by = mouse_.along(world_, way);
  if (!by) return std::nullopt;
  const double length = glm::dot(*by, way) / glm::dot(way, way);
  const double least = kLeastExtent * (sbb_.max[axis] - sbb_.min[axis]);
  modeler::Box sbb = sbb_;
  if (grip_->side == 0)
    sbb.min[axis] = std::min(sbb.min[axis] + length, sbb.max[axis] - least);
  else
    sbb.max[axis] = std::max(sbb.max[axis] + length, sbb.min[axis] + least);
  std::vector<std::string> options;
  add_option(options, "--sbb", {sbb.min.x, sbb.min.y, sbb.min.z, sbb.max.x, sbb.max.y, sbb.max.z});
  return joint_step("set", joint_name(), options);
}

// In the plane parallel to the screen, or along the surface's axis that is nearest to the mouse's way.
std::optional<Json> Hand::follow_point(bool along_axis) {
  const glm::dmat3 linear = linear_of(matrix_);
  std::optional<glm::dvec3> by = mouse_.across(world_);
  if (along_axis && mouse_.at() != mouse_.began()) {
    const auto likeness = [&](int axis) {
      const glm::dvec2 way = mouse_.screen().motion_of(world_, linear[axis]);
      const double length = glm::length(way);
      return length > 0 ? std::abs(glm::dot(way / length, mouse_.at() - mouse_.began())) : 0;
    };
    int nearest = 0;
    for (const int axis : {1, 2})
      if (likeness(axis) > likeness(nearest)) nearest = axis;
    by = mouse_.along(world_, linear[nearest]);
  }
  if (!by) return std::nullopt;
  const glm::dvec3 to = glm::clamp(place_ + glm::inverse(linear) * *by, 0.0, 1.0);  // shapes stay in their box
  std::vector<std::string> options{"--patch", std::to_string(grip_->patch), "--at", std::to_string(grip_->i),
                                   std::to_string(grip_->j)};
  add_option(options, "--to", {to.x, to.y, to.z});
  return joint_step("point", joint_name(), options);
}

glm::dvec3 pose_towards(const Posed& joint, const glm::dvec3& place, const glm::dvec3& from, const Screen& screen,
                        const glm::dvec2& pixel) {
  constexpr int kSteps = 60;
  constexpr double kNear = 0.01, kMostDegrees = 20;  // pixels; of one step
  constexpr double kTwist = 0.4;                     // of the longest lever
  Posed posed = joint;
  posed.pose = from;
  const auto place_of = [&](const glm::dvec3& pose) {
    return posed.center + posed.parent.turn * (modeler::orientation(*posed.joint, pose) * place);
  };
  const auto error_of = [&](const glm::dvec3& pose) -> std::optional<glm::dvec2> {
    const auto at = screen.pixel_of(place_of(pose));
    if (!at) return std::nullopt;
    return pixel - *at;
  };
  auto error = error_of(from);
  double damping = 1e-4;
  for (int step = 0; step < kSteps && error && glm::length(*error) > kNear; ++step) {
    const glm::dvec3 at = place_of(posed.pose);
    glm::dvec2 slopes[3];  // pixels a degree
    double levers[3];
    for (int i = 0; i < 3; ++i) {
      const TurnAxis axis = posed.axis(i);
      const glm::dvec3 way = glm::cross(axis.axis, at - axis.center);
      levers[i] = axis.limits.free() ? glm::length(way) : 0;
      slopes[i] = modeler::kDegree * screen.motion_of(at, way);
      // What is at its limit and would go beyond stays.
      const double wanted = glm::dot(slopes[i], *error);
      const bool stops =
          (posed.pose[i] <= axis.limits.lower && wanted < 0) || (posed.pose[i] >= axis.limits.upper && wanted > 0);
      if (!axis.limits.free() || stops) slopes[i] = glm::dvec2(0);
    }
    // The place hardly moves about an axis that it is near. Such an axis rests, or it would turn the joint to its limit
    // as soon as other axes are at theirs.
    for (int i = 0; i < 3; ++i)
      if (levers[i] < kTwist * *std::ranges::max_element(levers)) slopes[i] = glm::dvec2(0);
    glm::dmat3 normal(0);
    glm::dvec3 right(0);
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) normal[k][i] = glm::dot(slopes[i], slopes[k]);
      right[i] = glm::dot(slopes[i], *error);
      largest = std::max(largest, normal[i][i]);
    }
    if (largest == 0) break;
    for (int i = 0; i < 3; ++i) normal[i][i] += damping * largest;
    glm::dvec3 by = glm::inverse(normal) * right;
    const double most = std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)});
    if (most > kMostDegrees) by *= kMostDegrees / most;
    const glm::dvec3 next = animator::clamped(*posed.joint, posed.pose + by);
    const auto left = error_of(next);
    if (left && glm::length(*left) < glm::length(*error)) {
      posed.pose = next;
      error = left;
      damping = std::max(damping / 4, 1e-9);
    } else {
      damping *= 8;
      if (damping > 1e6) break;
    }
  }
  return posed.pose;
}

}  // namespace mars::studio
