#include "host/studio/stage/mark_hand.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/modeler/frames.h"
#include "host/studio/stage/hand.h"

namespace mars::studio {
namespace {

constexpr double kLeastAngle = 1, kMostAngle = 160;  // degrees
constexpr double kLeastReach = 1e-3;

}  // namespace

std::optional<Json> MarkHand::follow(const glm::dvec2& mouse, bool shift) {
  mouse_.follow(mouse, shift);
  return grip_.what == Grip::What::size ? sized() : moved();
}

Json MarkHand::step() const {
  if (!grip_.mark->light) return {{"set", "camera"}};
  return {{"set", "light"}, {"light", *grip_.mark->light + 1}};
}

std::optional<Json> MarkHand::moved() const {
  const glm::dvec3& from = grip_.aim ? *state_.aim : state_.place;
  glm::dvec3 way(0);
  way[grip_.axis] = 1;
  const auto by = grip_.what == Grip::What::plane ? mouse_.across(from) : mouse_.along(from, way);
  if (!by) return std::nullopt;
  Json made = step();
  const glm::dvec3 to = from + *by;
  if (grip_.aim)
    made["at"] = listed(to);
  else if (!grip_.mark->light)
    made["eye"] = listed(to);
  else if (!state_.far)
    made["place"] = listed(to);
  else if (glm::length(to - state_.center) > 0)
    made["direction"] = listed(glm::normalize(to - state_.center));
  else
    return std::nullopt;
  return made;
}

// What is pulled is the edge of a circle: as far from the axis at what it aims at, or from the place.
std::optional<Json> MarkHand::sized() const {
  Json made = step();
  if (state_.angle == 0) {
    const glm::dvec3& way = mouse_.screen().right();
    const auto by = mouse_.along(state_.place + state_.reach * way, way);
    if (!by) return std::nullopt;
    made["reach"] = std::max(state_.reach + glm::dot(*by, way), kLeastReach);
    return made;
  }
  const double distance = glm::length(*state_.aim - state_.place);
  const double radius = distance * std::tan(state_.angle / 2 * modeler::kDegree);
  const auto by = mouse_.along(*state_.aim + radius * state_.up, state_.up);
  if (!by || distance == 0) return std::nullopt;
  const double wide = 2 * std::atan((radius + glm::dot(*by, state_.up)) / distance) / modeler::kDegree;
  const double angle = std::clamp(wide, kLeastAngle, kMostAngle);
  if (grip_.mark->light)
    made["cone"] = {angle * state_.inner / state_.angle, angle};
  else
    made["fov"] = angle;
  return made;
}

}  // namespace mars::studio
