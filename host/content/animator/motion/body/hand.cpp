#include "host/content/animator/motion/body/hand.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "host/content/animator/motion/body/finger_names.h"
#include "host/content/animator/motion/body/stance.h"
#include "host/content/animator/motion/body/surface.h"

namespace mars::motion {
namespace {

constexpr double kAlong = 0.45;      // of the hand, where its palm is
constexpr double kThick = 0.45;      // of how far its box is out on the inner side
constexpr double kToFingers = 0.85;  // of the way to the roots of its fingers, where it has some: on the palm's skin

// How far a joint's own segment reaches from it, as drawn, along a direction; of a skin what moves with the joint.
double extent(const modeler::Model& model, std::size_t number, const glm::dvec3& direction) {
  const modeler::Joint& joint = model.joints[number];
  if (!joint.segment || !joint.segment->bones.empty())
    return reach_of_skin(model, number, direction,
                         [&](std::size_t each) { return modeler::is_at_or_below(model.joints, each, number); });
  double most = 0;
  const modeler::Axes frame = modeler::segment_frame({}, joint);
  const modeler::Box& box = joint.segment->sbb;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
    most = std::max(most, glm::dot(frame.turn * point, direction));
  }
  return most;
}

// On the skin of a palm from which fingers go; none: there are none.
std::optional<glm::dvec3> palm_before_fingers(const modeler::Model& model, const Hand& hand) {
  const Posture drawn = drawn_posture(model);
  const glm::dvec3 wrist = frame_in(model, drawn, hand.end).place;
  glm::dvec3 sum(0);
  double farthest = 0;
  std::vector<glm::dvec3> roots;
  for (const std::size_t joint : finger_joints_below(model, hand.end))
    if (model.joints[joint].parent == hand.end) {
      roots.push_back(frame_in(model, drawn, joint).place - wrist);
      farthest = std::max(farthest, glm::dot(roots.back(), hand.fingers));
    }
  // Not of the thumb's.
  std::erase_if(roots, [&](const glm::dvec3& root) { return glm::dot(root, hand.fingers) < 0.6 * farthest; });
  if (roots.empty()) return std::nullopt;
  for (const glm::dvec3& root : roots) sum += root / double(roots.size());
  const glm::dvec3 flat = kToFingers * (sum - glm::dot(sum, hand.palm) * hand.palm);
  double out = 0;
  for (const glm::dvec3& point : points_of(model, drawn, [&](std::size_t joint) { return joint == hand.end; })) {
    const glm::dvec3 from = point - wrist - flat;
    const double height = glm::dot(from, hand.palm);
    if (glm::length(from - height * hand.palm) < 0.25 * farthest) out = std::max(out, height);
  }
  if (out <= 0) return std::nullopt;
  return flat + out * hand.palm;
}

glm::dmat3 frame_along(const glm::dvec3& first, const glm::dvec3& about) {
  const glm::dvec3 third = glm::normalize(glm::cross(first, about));
  return {first, glm::cross(third, first), third};
}

}  // namespace

std::vector<std::size_t> Hand::joints() const {
  return end == elbow ? std::vector{shoulder, elbow} : std::vector{shoulder, elbow, end};
}

Hand hand_of(const Body& body, modeler::Side side, const std::string& command) {
  const std::size_t shoulder = needed(body, modeler::Limb::shoulder, side, command);
  const std::size_t elbow = needed(body, modeler::Limb::elbow, side, command);
  const std::size_t wrist = body.find(modeler::Limb::wrist, side);
  const Posture drawn = drawn_posture(*body.model);
  const auto place = [&](std::size_t joint) { return frame_in(*body.model, drawn, joint).place; };
  Hand hand{side, shoulder, elbow, wrist == modeler::kNone ? elbow : wrist, {}, {}, {}, 0, 0};
  hand.fingers = glm::normalize(wrist == modeler::kNone ? place(elbow) - place(shoulder) : place(wrist) - place(elbow));
  // Of an arm that hangs the palm faces the body.
  const glm::dmat3 hang = body.axes * hanging_shoulder(body, side, {0, 0, 0}) * glm::transpose(body.axes);
  hand.palm = glm::transpose(hang) * body.axes[1] * -sign_of(side);
  hand.palm = glm::normalize(hand.palm - glm::dot(hand.palm, hand.fingers) * hand.fingers);
  const auto reach = [&](const glm::dvec3& direction) { return extent(*body.model, hand.end, direction); };
  hand.grip = palm_before_fingers(*body.model, hand)
                  .value_or(kAlong * reach(hand.fingers) * hand.fingers + kThick * reach(hand.palm) * hand.palm);
  hand.upper = glm::distance(place(shoulder), place(elbow));
  hand.fore =
      (wrist == modeler::kNone ? 0 : glm::distance(place(elbow), place(wrist))) + glm::dot(hand.grip, hand.fingers);
  return hand;
}

glm::dmat3 hand_turn(const Hand& hand, const glm::dvec3& palm, const glm::dvec3& fingers) {
  return frame_along(palm, fingers) * glm::transpose(frame_along(hand.palm, hand.fingers));
}

}  // namespace mars::motion
