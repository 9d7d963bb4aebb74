// Which hand a gesture has: by what was taken, and with which tool.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "host/studio/stage/hand.h"
#include "host/studio/stage/mark_hand.h"
#include "host/studio/stage/reach_hand.h"

namespace mars::studio {

using AnyHand = std::variant<Hand, MarkHand, ReachHand>;

// Where a hand begins.
struct Beginning {
  const Project& project;
  const Moments& moments;
  Tool tool;
  RingAxes axes;
  Screen screen;
  glm::dvec2 pixel;
  std::vector<std::size_t> pins;  // joints of the actor that it takes
};

// By a handle's grip; or by the surface of a joint: none if that cannot follow.
AnyHand hand_on(const Beginning& beginning, const Selection& held, const Grip& grip);
std::optional<AnyHand> hand_on(const Beginning& beginning, const Selection& held, const Hit& hit);

// The step that follows the mouse; nothing where none does.
std::optional<Json> followed(AnyHand& hand, const glm::dvec2& mouse, bool shift);

}  // namespace mars::studio
