#include "host/content/animator/motion/goals/reaching.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/curve.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/body/hand.h"
#include "host/content/animator/motion/body/pull.h"
#include "host/content/animator/motion/body/reach.h"
#include "host/content/animator/motion/scene/target.h"

namespace mars::motion {
namespace {

constexpr Parameter kReachParameters[] = {
    {"limb", "LIMB", "left-hand, right-hand, left-foot, right-foot, head, or a joint; default: right-hand",
     "left-foot"},
    {"to", "X Y Z", "where the palm, the ankle or the joint goes", "1.2 -0.4 3"},
    {"of", "ACTOR[/JOINT]", "instead of to: an actor, or one of its joints; a hand touches the actor", "ball"},
    {"along", "PART",
     "what moves, too, if the limb is too short: limb (nothing), trunk, or body, whose knees bend; "
     "default: trunk",
     "body"},
    {"seconds", "S", "default: 1", "1.5"}};
constexpr Parameter kPlant[] = {
    {"limb", "LIMB", "left-foot, right-foot, feet, left-hand, right-hand, hands, or a joint; default: feet", "hands"},
    {"seconds", "S", "default: up to the figure's last key", "2"}};

constexpr double kFarFromTarget = 0.003;  // of the chain's length: what is nearer is there
constexpr double kReachTolerance = 0.01;  // degrees between keys

using modeler::Limb;
using modeler::Side;

std::size_t limb_named(const Scene& scene, const std::string& name) {
  const modeler::Limbs& limbs = scene.model().limbs;
  for (const Side side : kSides) {
    const std::string prefix = side == Side::left ? "left-" : "right-";
    const std::size_t wrist = limbs.of(Limb::wrist, side), ankle = limbs.of(Limb::ankle, side);
    if (name == prefix + "hand" && (wrist != modeler::kNone || limbs.of(Limb::elbow, side) != modeler::kNone))
      return wrist != modeler::kNone ? wrist : limbs.of(Limb::elbow, side);
    if (name == prefix + "foot" && ankle != modeler::kNone) return ankle;
  }
  if (name == "head" && limbs.of(modeler::Trunk::head) != modeler::kNone) return limbs.of(modeler::Trunk::head);
  return joint_named(scene, scene.model(), "limb", name);
}

double length_of(const modeler::Model& model, const Chain& chain) {
  double sum = 0;
  for (const std::size_t joint : chain.joints)
    if (joint != chain.joints.front()) sum += glm::length(model.joints[joint].place);
  return sum > 0 ? sum : 1;
}

std::string rounded_text(double value) { return document::shown(std::round(value * 1e4) / 1e4 + 0.0); }

// ---- Reaching

// What of a limb goes to the place: of a hand its palm, or what lies on it that is so thick.
glm::dvec3 held_of(const Scene& scene, std::size_t end, double radius) {
  const modeler::Limbs& limbs = scene.model().limbs;
  for (const Side side : kSides) {
    const std::size_t wrist = limbs.of(Limb::wrist, side), elbow = limbs.of(Limb::elbow, side);
    if (end != (wrist == modeler::kNone ? elbow : wrist)) continue;
    if (limbs.of(Limb::shoulder, side) == modeler::kNone || elbow == modeler::kNone) continue;
    return hand_of(body_without_legs(scene.model(), scene.actor.name), side, "reach").around(radius);
  }
  return {0, 0, 0};
}

// Of an actor that a hand touches.
double radius_of(const Scene& scene, std::uint32_t last) {
  const auto of = target_of(scene, "of");
  if (!of || of->joint != modeler::kNone) return 0;
  const Block block = block_of(scene, *of, last);
  return std::min({block.half.x, block.half.y, block.half.z});
}

glm::dvec3 goal_of(const Scene& scene, std::uint32_t last) {
  const auto to = scene.arguments.vector("to");
  const auto of = target_of(scene, "of");
  if (to && of) scene.arguments.refuse("to", "stands beside of", "give one of them");
  if (!to && !of) scene.arguments.refuse("to", "is missing", "say where: to 1 0 2, or of ACTOR");
  return to ? *to : place_of(scene.film, *of, last);
}

std::vector<std::size_t> feet_of(const modeler::Model& model) {
  std::vector<std::size_t> feet;
  for (const Side side : kSides)
    if (const std::size_t ankle = model.limbs.of(Limb::ankle, side); ankle != modeler::kNone) feet.push_back(ankle);
  return feet;
}

// ---- Planting

// A limb, and where it stays.
struct Planted {
  Chain chain;
  modeler::Axes frame;
};

std::vector<std::size_t> planted_joints(const Scene& scene) {
  const std::string name = scene.arguments.word("limb").value_or("feet");
  if (name != "feet" && name != "hands") return {limb_named(scene, name)};
  const std::string each = name == "feet" ? "foot" : "hand";
  return {limb_named(scene, "left-" + each), limb_named(scene, "right-" + each)};
}

// Those that the limb's own turns cannot keep there are a Failure.
void keep(const Scene& scene, const Planted& planted, std::uint32_t frame, Posture& posture) {
  const double length = length_of(scene.model(), planted.chain);
  std::vector<Goal> goals{{.joint = planted.chain.end,
                           .place = planted.frame.place,
                           .turn = planted.frame.turn,
                           .turn_weight = 0.3 * length}};
  reach(scene.model(), posture, planted.chain.joints, goals);
  const auto off = [&] {
    return glm::distance(frame_in(scene.model(), posture, planted.chain.end).place, planted.frame.place);
  };
  if (off() > 1e-6 * length) {  // where not all can be had, the place comes first
    goals[0].turn.reset();
    reach(scene.model(), posture, planted.chain.joints, goals);
  }
  if (off() > kFarFromTarget * length)
    throw Failure("'" + scene.model().joints[planted.chain.end].name + "' cannot stay where it is: it is " +
                      rounded_text(off()) + " away at frame " + std::to_string(frame),
                  scene.where(), "plant it for less long, or key the rest of the figure nearer to it");
}

}  // namespace

std::span<const Parameter> reach_parameters() { return kReachParameters; }
std::span<const Parameter> plant_parameters() { return kPlant; }

Motion reach(const Scene& scene) {
  const modeler::Model& model = scene.model();
  constexpr std::string_view extents[] = {"limb", "trunk", "body"};
  const auto extent = static_cast<Extent>(scene.arguments.choice("along", 1, extents));
  const std::size_t end = limb_named(scene, scene.arguments.word("limb").value_or("right-hand"));
  const double seconds = scene.arguments.number("seconds", 1, {0.04, 60});
  const std::uint32_t last = scene.last_after(std::max(1.0, std::round(scene.frames(seconds))));
  const Chain chain = chain_of(model, end, extent);
  const Pull pulled{.held = held_of(scene, end, radius_of(scene, last)), .to = goal_of(scene, last)};
  const Posture start = posture_of(scene);
  std::vector<std::size_t> pins = extent == Extent::body ? feet_of(model) : std::vector<std::size_t>{};
  std::erase(pins, end);
  Posture there = start;
  const double left = pull(model, start, there, chain, pulled, pins);
  if (left > kFarFromTarget * length_of(model, chain))
    throw Failure("'" + model.joints[end].name + "' cannot reach " + document::shown(animator::rounded(pulled.to.x)) +
                      " " + document::shown(animator::rounded(pulled.to.y)) + " " +
                      document::shown(animator::rounded(pulled.to.z)) + ": " + rounded_text(left) + " are missing",
                  scene.where(),
                  extent == Extent::body ? "let the figure go nearer first, by the action walk"
                                         : "let the figure go nearer first, or more of it go along: along body");
  std::vector<Posture> postures;
  for (std::uint32_t frame = scene.at; frame <= last; ++frame) {
    const double part = smooth(scene.at, last, frame);
    Posture posture = start;
    posture.place = glm::mix(start.place, there.place, part);
    for (std::size_t joint = 0; joint < posture.pose.size(); ++joint)
      posture.pose[joint] = glm::mix(start.pose[joint], there.pose[joint], part);
    for (const std::size_t pin : pins) keep(scene, {chain_of(model, pin), frame_in(model, start, pin)}, frame, posture);
    postures.push_back(std::move(posture));
  }
  std::vector<std::size_t> joints = chain.trunk;
  joints.insert(joints.end(), chain.joints.begin(), chain.joints.end());
  if (!chain.moves_actor) return {keys_of_joints(model, joints, postures, scene.at, kReachTolerance), last};
  for (const std::size_t pin : pins)
    for (const std::size_t joint : chain_of(model, pin).joints) joints.push_back(joint);
  return {keys_of(body_of(model, scene.actor.name, "reach"), joints, postures, scene.at), last};
}

Motion plant(const Scene& scene) {
  const modeler::Model& model = scene.model();
  const Posture start = posture_of(scene);
  std::vector<Planted> planted;
  std::vector<std::size_t> joints;
  for (const std::size_t end : planted_joints(scene)) {
    planted.push_back({chain_of(model, end), frame_in(model, start, end)});
    joints.insert(joints.end(), planted.back().chain.joints.begin(), planted.back().chain.joints.end());
  }
  const std::uint32_t end = animator::last_key(scene.actor.motion);
  const auto seconds = scene.arguments.number("seconds", {0.04, 600});
  if (!seconds && end <= scene.at)
    scene.arguments.refuse("seconds", "is missing, and nothing moves after frame " + std::to_string(scene.at),
                           "plant at the frame from which it shall stay, while the figure moves");
  const std::uint32_t last = seconds ? scene.last_after(std::max(1.0, std::round(scene.frames(*seconds)))) : end;
  std::vector<Posture> postures;
  for (std::uint32_t frame = scene.at; frame <= last; ++frame) {
    Posture posture = posture_of({scene.film, scene.actor, frame, scene.arguments, scene.action});
    if (!postures.empty())
      for (const std::size_t joint : joints) posture.pose[joint] = postures.back().pose[joint];
    for (const Planted& each : planted) keep(scene, each, frame, posture);
    postures.push_back(std::move(posture));
  }
  return {keys_of_joints(model, joints, postures, scene.at, kReachTolerance), last};
}

}  // namespace mars::motion
