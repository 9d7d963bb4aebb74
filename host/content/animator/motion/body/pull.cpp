#include "host/content/animator/motion/body/pull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/motion/body/reach.h"

namespace mars::motion {
namespace {

// Beside a pull's one: how much a pin's place and turn count, a pull's turn, and what is drawn to rest; angles times
// the figure's size. So far apart that what comes later costs what comes before it less than is seen.
constexpr double kPullPinWeight = 3, kPullTurnWeight = 1e-2;
constexpr double kLimb = 1e-2, kEnd = 3e-2, kTrunk = 1e-1, kActor = 1e-1;
constexpr double kSmallStep = 1e-7;  // radians, and units
constexpr double kExactly = 0.03;
constexpr double kSmallGain = 1e-3;    // of the error
constexpr double kStraight = 0.99996;  // cosine of half a degree
constexpr double kStride = 0.1;        // of the size
constexpr double kBend = 1;            // degrees
constexpr double kBeyond = 1.02;       // of what a chain can reach: farther it makes no difference

using modeler::kNone;
using modeler::Limb;
using modeler::Trunk;

// From `top` down to `joint`, both included.
std::vector<std::size_t> path(const modeler::Model& model, std::size_t top, std::size_t joint) {
  std::vector<std::size_t> joints{joint};
  while (joint != top && model.joints[joint].parent != kNone) joints.push_back(joint = model.joints[joint].parent);
  std::reverse(joints.begin(), joints.end());
  return joints;
}

// The limb that a joint belongs to.
struct Member {
  std::size_t top = kNone;   // of the limb
  std::size_t last = kNone;  // what hangs below it turns with it
};

Member first_of(const modeler::Model& model, std::size_t joint, std::span<const std::size_t> limb) {
  Member member;
  for (const std::size_t part : limb) {
    if (part == kNone) continue;
    if (member.top == kNone) member.top = part;
    if (modeler::is_at_or_below(model.joints, joint, part)) member.last = part;
  }
  if (member.last == kNone) member.top = kNone;
  return member;
}

Member member_of(const modeler::Model& model, std::size_t joint) {
  const modeler::Limbs& limbs = model.limbs;
  for (const modeler::Side side : {modeler::Side::left, modeler::Side::right}) {
    const std::size_t arm[] = {limbs.of(Limb::shoulder, side), limbs.of(Limb::elbow, side),
                               limbs.of(Limb::wrist, side)};
    const std::size_t leg[] = {limbs.of(Limb::hip, side), limbs.of(Limb::knee, side), limbs.of(Limb::ankle, side)};
    for (const auto& limb : {arm, leg})
      if (const Member found = first_of(model, joint, std::span(limb, 3)); found.top != kNone) return found;
  }
  const std::size_t back[] = {limbs.of(Trunk::spine), limbs.of(Trunk::chest), limbs.of(Trunk::neck),
                              limbs.of(Trunk::head)};
  return first_of(model, joint, back);
}

std::size_t children_of(const modeler::Model& model, std::size_t joint) {
  return std::size_t(std::count_if(model.joints.begin(), model.joints.end(),
                                   [&](const modeler::Joint& each) { return each.parent == joint; }));
}

// Up to below the nearest joint that carries several, or the root.
std::size_t top_of(const modeler::Model& model, std::size_t joint) {
  while (model.joints[joint].parent != kNone && children_of(model, model.joints[joint].parent) == 1)
    joint = model.joints[joint].parent;
  return joint;
}

// The longest way from joint to joint.
double size_of(const modeler::Model& model) {
  std::vector<double> far;
  double most = 0;
  for (const modeler::Joint& joint : model.joints) {
    far.push_back(joint.parent == kNone ? 0 : far[joint.parent] + glm::length(joint.place));
    most = std::max(most, far.back());
  }
  return most > 0 ? most : 1;
}

// A joint between two others of a limb.
struct Link {
  std::size_t before, joint, after;
};

// What of a figure changes for one pull, and what is wanted of it.
class Pulling {
 public:
  Pulling(const modeler::Model& model, const Posture& rest, const Chain& chain, const Pull& pull,
          std::span<const std::size_t> pins)
      : model_(model), rest_(rest), chain_(chain), pull_(pull), size_(size_of(model)) {
    for (const std::size_t joint : chain.trunk) add(joint, kTrunk);
    add_limb(chain);
    goals_.push_back(
        {.joint = chain.end, .place = within_reach(), .turn = pull.turn, .turn_weight = kPullTurnWeight * size_});
    goals_.back().held = pull.held;
    for (const std::size_t pin : pins)
      if (moves(pin)) hold(pin);
  }

  double solve(Posture& posture) {
    approach(posture);
    for (const double share : {1.0, kExactly}) {
      bend(posture);
      search(posture, share);
    }
    settle(posture);
    return glm::distance(held_in(posture), pull_.to);
  }

 private:
  void add(std::size_t joint, double stiffness) {
    if (std::find(joints_.begin(), joints_.end(), joint) != joints_.end()) return;
    joints_.push_back(joint);
    stiffness_.push_back(stiffness * size_);
  }

  void add_limb(const Chain& limb) {
    for (const std::size_t joint : limb.joints) add(joint, joint == limb.end ? kEnd : kLimb);
    for (std::size_t i = 1; i + 1 < limb.joints.size(); ++i)
      inner_.push_back({limb.joints[i - 1], limb.joints[i], limb.joints[i + 1]});
  }

  bool moves(std::size_t pin) const {
    if (chain_.moves_actor) return true;
    return std::any_of(joints_.begin(), joints_.end(),
                       [&](std::size_t joint) { return modeler::is_at_or_below(model_.joints, pin, joint); });
  }

  void hold(std::size_t pin) {
    const Chain limb = chain_of(model_, pin);
    add_limb(limb);
    held_.insert(held_.end(), limb.joints.begin(), limb.joints.end());
    const modeler::Axes frame = frame_in(model_, rest_, pin);
    goals_.push_back(
        {.joint = pin, .place = frame.place, .turn = frame.turn, .turn_weight = 0.2 * kPullPinWeight * size_});
    goals_.back().place_weight = kPullPinWeight;
  }

  std::size_t top() const {
    if (!chain_.trunk.empty()) return chain_.trunk.front();
    return chain_.joints.empty() ? chain_.end : chain_.joints.front();
  }

  // From the chain's top to what is pulled, if all is stretched.
  double stretched() const {
    double sum = glm::length(pull_.held);
    for (std::size_t joint = chain_.end; joint != top() && joint != kNone; joint = model_.joints[joint].parent)
      sum += glm::length(model_.joints[joint].place);
    return sum;
  }

  glm::dvec3 top_place() const { return frame_in(model_, rest_, top()).place; }

  glm::dvec3 within_reach() const {
    if (chain_.moves_actor) return pull_.to;
    const glm::dvec3 from = top_place(), way = pull_.to - from;
    const double far = glm::length(way), most = kBeyond * stretched();
    return far > most ? from + most / far * way : pull_.to;
  }

  glm::dvec3 held_in(const Posture& posture) const {
    const modeler::Axes frame = frame_in(model_, posture, chain_.end);
    return frame.turn * pull_.held + frame.place;
  }

  // Where it is far to go, in strides: a search that begins near ends near.
  void approach(Posture& posture) {
    Goal& goal = goals_.front();
    const glm::dvec3 from = held_in(posture), to = *goal.place;
    const double strides = std::ceil(glm::distance(from, to) / (kStride * size_));
    for (double stride = 1; stride < strides; ++stride) {
      goal.place = glm::mix(from, to, stride / strides);
      bend(posture);
      search(posture, 1);
      if (glm::distance(held_in(posture), *goal.place) > kStride * size_) break;
    }
    goal.place = to;
  }

  // Stiffly first, which leads to the posture near rest, then so weakly that the pull is met.
  void search(Posture& posture, double share) const {
    std::vector<double> stiffness;
    for (const double each : stiffness_) stiffness.push_back(share * each);
    Search search{.joints = joints_, .moves_actor = chain_.moves_actor, .rest = &rest_, .stiffness = stiffness};
    search.place_stiffness = share * kActor;
    search.small_step = kSmallStep;
    search.small_gain = kSmallGain;
    reach(model_, posture, search, goals_);
  }

  // Where the pull cannot be met it has drawn at the pins, too: their limbs take them back, with the actor where these
  // are too short.
  void settle(Posture& posture) const {
    const auto pins = std::span(goals_).subspan(1);
    if (pins.empty()) return;
    reach(model_, posture, {.joints = held_, .small_step = kSmallStep}, pins);
    if (chain_.moves_actor)
      reach(model_, posture, {.joints = held_, .moves_actor = true, .small_step = kSmallStep}, pins);
  }

  // A straight limb does not know which way to bend: the search begins with one that is bent a little.
  void bend(Posture& posture) const {
    for (const Link& link : inner_) {
      const modeler::Joint& joint = model_.joints[link.joint];
      const glm::dvec3 place = frame_in(model_, posture, link.joint).place;
      const glm::dvec3 before = place - frame_in(model_, posture, link.before).place;
      const glm::dvec3 after = frame_in(model_, posture, link.after).place - place;
      if (glm::dot(before, after) < kStraight * glm::length(before) * glm::length(after)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const modeler::Limits& limits = joint.limits[axis];
        double& value = posture.pose[link.joint][axis];
        const double inward = limits.upper - value > value - limits.lower ? kBend : -kBend;
        value = std::clamp(value + inward, limits.lower, limits.upper);
      }
    }
  }

  const modeler::Model& model_;
  const Posture& rest_;
  const Chain& chain_;
  const Pull& pull_;
  double size_;
  std::vector<std::size_t> joints_;
  std::vector<double> stiffness_;
  std::vector<Link> inner_;
  std::vector<std::size_t> held_;  // joints of pinned limbs
  std::vector<Goal> goals_;
};

}  // namespace

Chain chain_of(const modeler::Model& model, std::size_t joint, Extent extent) {
  Chain chain{joint, {}, {}};
  const std::size_t pelvis = model.limbs.of(Trunk::pelvis);
  const bool pulls_pelvis = joint == pelvis && pelvis != kNone;
  chain.moves_actor = extent == Extent::body || pulls_pelvis;
  if (pulls_pelvis) return chain;
  const Member member = member_of(model, joint);
  const std::size_t top = member.top == kNone ? top_of(model, joint) : member.top;
  chain.joints = path(model, top, member.top == kNone ? joint : member.last);
  const std::size_t above = model.joints[top].parent;
  if (extent == Extent::limb || above == kNone) return chain;
  chain.trunk = path(model, kNone, above);
  // What carries the pelvis, as nodes of other programs' figures do, carries the feet.
  std::erase_if(chain.trunk, [&](std::size_t each) {
    return pelvis != kNone && modeler::is_at_or_below(model.joints, pelvis, each) &&
           (each != pelvis || extent == Extent::trunk);
  });
  return chain;
}

double pull(const modeler::Model& model, const Posture& rest, Posture& posture, const Chain& chain, const Pull& pull,
            std::span<const std::size_t> pins) {
  return Pulling(model, rest, chain, pull, pins).solve(posture);
}

}  // namespace mars::motion
