#include "host/studio/stage/hands.h"
#include "host/studio/stage/reach_place.h"

namespace mars::studio {

AnyHand hand_on(const Beginning& beginning, const Selection& held, const Grip& grip) {
  const auto& [project, moments, tool, axes, screen, pixel, pins] = beginning;
  if (held.mark) return MarkHand(project, grip, state_of(project, moments, *held.mark), screen, pixel);
  if (tool == Tool::reach) return ReachHand(project, held, pins, grip, screen, pixel);
  Hand hand(project, held, screen, pixel);
  hand.take(grip, axes);
  return hand;
}

std::optional<AnyHand> hand_on(const Beginning& beginning, const Selection& held, const Hit& hit) {
  const auto& [project, moments, tool, axes, screen, pixel, pins] = beginning;
  if (tool == Tool::reach && can_reach(project, held)) return ReachHand(project, held, pins, hit.place, screen, pixel);
  Hand hand(project, held, screen, pixel);
  if (!hand.take(hit)) return std::nullopt;
  return hand;
}

std::optional<Json> followed(AnyHand& hand, const glm::dvec2& mouse, bool shift) {
  return std::visit([&](auto& each) { return each.follow(mouse, shift); }, hand);
}

}  // namespace mars::studio
