#include "host/content/animator/motion/body/crouch.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kCrouchLean = 100;  // degrees of the trunk at the lowest
constexpr double kThigh = 84;        // degrees of the thighs from upright, and
constexpr double kShin = 24;         // of the shins, the other way
constexpr double kHang = 0.7;        // of the lean, that arms hang forward
constexpr const char* kCrouchRemedy = "let it stand nearer, or widen the joint's limits in its model";

struct Share {
  modeler::Trunk part;
  double lean, twist;
};
constexpr Share kShares[] = {{modeler::Trunk::spine, 0.28, 0.3},
                             {modeler::Trunk::chest, 0.22, 0.5},
                             {modeler::Trunk::neck, -0.1, 0.1},
                             {modeler::Trunk::head, -0.1, 0.1}};

}  // namespace

Crouch::Crouch(const Body& body, const Posture& start, const std::string& where)
    : body_(body), start_(start), where_(where), stance_(stance_of(body, start)) {
  const bool upright = body.is_upright(start);
  knees_ = upright && !body.stiff();
  for (Foot& foot : stance_.feet) {
    foot.askew = 10;
    foot.stands = upright;
  }
}

// Of the pelvis: thighs back and shins forward by shares of their most.
glm::dvec3 Crouch::lowered(double depth) const {
  if (!knees_) return {0, 0, 0};
  const Leg& leg = body_.legs[0];
  const double bend = elementary::pow(depth, 1.4), thigh = glm::radians(kThigh * bend),
               shin = glm::radians(kShin * bend);
  return {leg.shin * elementary::sin(shin) - leg.thigh * elementary::sin(thigh), 0,
          leg.thigh * (elementary::cos(thigh) - 1) + leg.shin * (elementary::cos(shin) - 1)};
}

void Crouch::take(double depth, double twist, Posture& posture) const {
  Stance stance = stance_;
  stance.pelvis += canonical_turn(0, 0, stance.heading) * lowered(depth);
  const double lean = kCrouchLean * depth;
  stance.tilt.y += 0.5 * lean;
  const auto turn = [&](std::size_t joint, const glm::dmat3& before, const glm::dmat3& after) {
    if (joint == modeler::kNone) return;
    const glm::dmat3 was =
        glm::transpose(body_.axes) * modeler::orientation(body_.model->joints[joint], start_.pose[joint]) * body_.axes;
    stance.turns[joint] = before * was * after;
  };
  for (const Share& share : kShares)
    turn(body_.find(share.part), glm::dmat3(1), canonical_turn(0, share.lean * lean, share.twist * twist));
  for (const modeler::Side side : kSides)
    turn(body_.find(modeler::Limb::shoulder, side), canonical_turn(0, -kHang * lean, 0), glm::dmat3(1));
  take_stance(body_, stance, posture, where_, kCrouchRemedy);
}

}  // namespace mars::motion
