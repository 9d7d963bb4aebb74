#include "host/studio/stage/mark_hand.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "host/content/animator/pose/joint_frames.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"
#include "host/studio/stage/hand_words.h"

namespace mars::studio {
namespace {

constexpr double kLeastAngle = 1, kMostAngle = 160;  // degrees
constexpr double kLeastReach = 1e-3, kLeastHeight = 1e-3;

}  // namespace

std::optional<Json> MarkHand::follow(const glm::dvec2& mouse, bool shift) {
  mouse_.follow(mouse, shift);
  return grip_.what == Grip::What::size ? sized() : moved();
}

Json MarkHand::step(const std::string& setting) const {
  const auto& light = grip_.mark->light;
  return set_step(project_, light ? "light/" + std::to_string(*light + 1) : "camera", {setting});
}

// Of a point of the camera that goes along with an actor, its offset in the key that rules there: none where it stands
// by itself.
std::optional<Json> MarkHand::offset_step(const glm::dvec3& to) const {
  if (grip_.mark->light) return std::nullopt;
  const animator::Film& film = project_.film();
  const auto& points = grip_.aim ? film.camera.at : film.camera.eye;
  const animator::Stretch stretch = animator::stretch_at(points, project_.frame());
  const animator::Point& point = points[stretch.from].value;
  if (point.actor == modeler::kNone) return std::nullopt;
  const animator::Actor& actor = film.actors[point.actor];
  const bool joint_axes = point.joint_axes && !grip_.aim;
  const modeler::Axes axes = animator::JointFrames(film).frame_of(point.actor, point.joint, project_.frame());
  glm::dvec3 offset = joint_axes ? glm::transpose(axes.turn) * (to - axes.place) : to - axes.place;
  const bool level = point.level && !grip_.aim;
  if (level) offset.z = to.z;
  const bool whole = point.joint == modeler::kNone;
  const std::uint32_t frame = stretch.from == stretch.to ? points[stretch.from].frame : project_.frame();
  const std::string target = actor.name + (whole ? "" : "/" + film.models[actor.model].joints[point.joint].name);
  editing::Command words{"animate", grip_.aim ? "look" : "follow", target,
                         "--frame", std::to_string(frame),         "--offset"};
  for (int axis = 0; axis < 3; ++axis) words.push_back(shown_number(offset[axis]));
  if (joint_axes) words.insert(words.end(), {"--axes", "joint"});
  if (level) words.push_back("--level");
  return step_of(words);
}

std::optional<Json> MarkHand::moved() const {
  const glm::dvec3& from = grip_.aim ? *state_.aim : state_.place;
  glm::dvec3 way(0);
  way[grip_.axis] = 1;
  const auto by = grip_.what == Grip::What::plane ? mouse_.across(from) : mouse_.along(from, way);
  if (!by) return std::nullopt;
  const glm::dvec3 to = from + *by;
  if (auto made = offset_step(to)) return made;
  if (grip_.aim) return step("at=" + shown_numbers(to));
  if (!grip_.mark->light) return step("eye=" + shown_numbers(to));
  if (!state_.far) return step("place=" + shown_numbers(to));
  if (!(glm::length(to - state_.center) > 0)) return std::nullopt;
  return step("direction=" + shown_numbers(glm::normalize(to - state_.center)));
}

// What is pulled is the edge of a circle: as far from the axis at what it aims at, or from the place.
std::optional<Json> MarkHand::sized() const {
  if (state_.height > 0) {
    const auto by = mouse_.along(*state_.aim + state_.height / 2 * state_.up, state_.up);
    if (!by) return std::nullopt;
    return step("height=" + shown_number(std::max(state_.height + 2 * glm::dot(*by, state_.up), kLeastHeight)));
  }
  if (state_.angle == 0) {
    const glm::dvec3& way = mouse_.screen().right();
    const auto by = mouse_.along(state_.place + state_.reach * way, way);
    if (!by) return std::nullopt;
    return step("reach=" + shown_number(std::max(state_.reach + glm::dot(*by, way), kLeastReach)));
  }
  const double distance = glm::length(*state_.aim - state_.place);
  const double radius = distance * elementary::tan(state_.angle / 2 * modeler::kDegree);
  const auto by = mouse_.along(*state_.aim + radius * state_.up, state_.up);
  if (!by || distance == 0) return std::nullopt;
  const double wide = 2 * elementary::atan((radius + glm::dot(*by, state_.up)) / distance) / modeler::kDegree;
  const double angle = std::clamp(wide, kLeastAngle, kMostAngle);
  if (!grip_.mark->light) return step("fov=" + shown_number(angle));
  return step("cone=" + shown_numbers({angle * state_.inner / state_.angle, angle}));
}

}  // namespace mars::studio
