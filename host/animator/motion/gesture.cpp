#include "host/animator/motion/gesture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure.h"
#include "host/animator/motion/reach.h"
#include "host/animator/motion/stance.h"

namespace mars::host {
namespace {

constexpr double kEnough = 1;     // degrees that a nod may fall short
constexpr double kOff = 0.1;      // of the arm's length, that a waving hand may be off its place
constexpr double kRaise = 0.5;    // seconds
constexpr double kInward = -14, kOutward = 34;  // degrees of the forearm from upright

std::uint32_t frame_after(const Scene& scene, double seconds) {
  return scene.at + static_cast<std::uint32_t>(std::max(1.0, std::round(scene.frames(seconds))));
}

glm::dvec3 two_digits(const Joint& joint, const glm::dvec3& pose) {
  const glm::dvec3 even = glm::round(pose * 100.0) / 100.0;
  return {std::clamp(even.x, joint.limits[0].lower, joint.limits[0].upper),
          std::clamp(even.y, joint.limits[1].lower, joint.limits[1].upper),
          std::clamp(even.z, joint.limits[2].lower, joint.limits[2].upper)};
}

class Gesture {
 public:
  Gesture(const Scene& scene, std::vector<std::size_t> joints)
      : model_(scene.model()), joints_(std::move(joints)) {}

  void key(std::uint32_t frame, const Posture& posture, const Ease& ease) {
    ActorKey& key = keys_.emplace_back();
    key.frame = frame;
    for (const std::size_t joint : joints_)
      key.pose[model_.joints[joint].name] = two_digits(model_.joints[joint], posture.pose[joint]);
    key.ease = ease;
  }

  Motion motion() const { return {keys_, keys_.back().frame, ""}; }

 private:
  const Model& model_;
  std::vector<std::size_t> joints_;
  std::vector<ActorKey> keys_;
};

// ---- Nodding

// Bends a joint forward by as many degrees as it can of those wanted; returns how many.
double bend(const Body& body, std::size_t joint, double degrees, Posture& posture) {
  if (joint == kNone) return 0;
  const glm::dmat3 from = orientation(body.model->joints[joint], posture.pose[joint]);
  const glm::dmat3 now = glm::transpose(body.axes) * from * body.axes;
  posture.pose[joint] = numbers_for(body, joint, now * canonical_turn(0, degrees, 0), posture.pose[joint]);
  return glm::degrees(turn_between(from, orientation(body.model->joints[joint], posture.pose[joint])).angle);
}

Posture nodded(const Body& body, const Posture& start, std::size_t neck, std::size_t head, double depth,
               const Wishes& wishes) {
  Posture down = start;
  double left = depth - bend(body, neck, head == kNone ? depth : depth / 2, down);
  left -= bend(body, head, left, down);
  if (left > kEnough && neck != kNone && head != kNone) {
    down.pose[neck] = start.pose[neck];
    left -= bend(body, neck, depth / 2 + left, down) - depth / 2;
  }
  if (left > kEnough)
    wishes.refuse("depth", "is " + shown(depth) + " degrees, but " + (neck == kNone ? "" : "'" + body.joint_name(neck) + "'") +
                               (neck == kNone || head == kNone ? "" : " and ") +
                               (head == kNone ? "" : "'" + body.joint_name(head) + "'") + " can bend " +
                               shown(std::floor(depth - left)) + " from where they are",
                  "nod less, or widen the joint's limits in its model");
  return down;
}

// ---- Waving

struct Arm {
  std::size_t shoulder, elbow, wrist;
  double upper, fore;
};

Posture waving(const Body& body, const Posture& start, Side side, const Arm& arm, double outward, const std::string& where) {
  Posture posture = start;
  const double s = sign_of(side), tilt = glm::radians(outward);
  const glm::dmat3 facing = canonical_turn(0, 0, body.heading_of(start));
  const glm::dvec3 shoulder = frame_in(*body.model, start, arm.shoulder).place;
  const glm::dvec3 elbow = shoulder + arm.upper * (facing * glm::normalize(glm::dvec3(0.22, s, -0.05)));
  const glm::dvec3 wrist = elbow + arm.fore * (facing * glm::normalize(glm::dvec3(0.12, s * std::sin(tilt), std::cos(tilt))));
  posture.pose[arm.shoulder] = numbers_for(body, arm.shoulder, hanging_shoulder(body, side, {s * 95, 0, s * 80}), start.pose[arm.shoulder]);
  posture.pose[arm.elbow] = numbers_for(body, arm.elbow, hanging_elbow(body, side, {0, -80, 0}), start.pose[arm.elbow]);
  posture.pose[arm.wrist] = numbers_for(body, arm.wrist, glm::dmat3(1), start.pose[arm.wrist]);
  const std::size_t joints[] = {arm.shoulder, arm.elbow};
  const Goal goals[] = {{.joint = arm.elbow, .place = elbow}, {.joint = arm.wrist, .place = wrist}};
  reach(*body.model, posture, joints, goals);
  if (glm::distance(frame_in(*body.model, posture, arm.wrist).place, wrist) > kOff * (arm.upper + arm.fore))
    throw Failure("cannot raise its " + std::string(side == Side::left ? "left" : "right") + " hand to wave",
                  "actor '" + body.name + "', " + where,
                  "widen the limits of '" + body.joint_name(arm.shoulder) + "' or '" + body.joint_name(arm.elbow) +
                      "' in its model, or take the other hand");
  return posture;
}

Posture half_way(const Posture& a, const Posture& b) {
  Posture posture = a;
  for (std::size_t joint = 0; joint < a.pose.size(); ++joint) posture.pose[joint] = 0.5 * (a.pose[joint] + b.pose[joint]);
  return posture;
}

}  // namespace

Motion nod(const Scene& scene) {
  const Wishes& wishes = scene.wishes;
  const Body body = body_of(scene.model(), scene.actor.name, "nod");
  const std::size_t neck = body.find(Trunk::neck);
  const std::size_t head = neck == kNone ? needed(body, Trunk::head, "nod") : body.find(Trunk::head);
  const Posture start = posture_at(scene.model(), scene.actor.motion, scene.at);
  const Posture down = nodded(body, start, neck, head, wishes.number("depth", 24, {0.1, 120}), wishes);
  std::vector<std::size_t> joints{neck, head};
  std::erase(joints, kNone);
  const std::uint32_t times = wishes.count("times", 2, 1000);
  const double seconds = wishes.number("seconds", 0.6, {0.1, 60});
  Gesture gesture(scene, joints);
  for (std::uint32_t time = 0; time < times; ++time) {
    gesture.key(frame_after(scene, seconds * time) - (time == 0), start, kBoth);
    gesture.key(frame_after(scene, seconds * (time + 0.45)), down, kBoth);
  }
  gesture.key(frame_after(scene, seconds * times), start, kLinear);
  return gesture.motion();
}

Motion wave(const Scene& scene) {
  const Wishes& wishes = scene.wishes;
  const Body body = body_of(scene.model(), scene.actor.name, "wave");
  constexpr std::string_view hands[] = {"left", "right"};
  const Side side = kSides[wishes.choice("hand", 1, hands)];
  Arm arm{needed(body, Limb::shoulder, side, "wave"), needed(body, Limb::elbow, side, "wave"),
          needed(body, Limb::wrist, side, "wave"), 0, 0};
  const Posture start = posture_at(scene.model(), scene.actor.motion, scene.at);
  const auto place = [&](std::size_t joint) { return frame_in(scene.model(), start, joint).place; };
  arm.upper = glm::distance(place(arm.shoulder), place(arm.elbow));
  arm.fore = glm::distance(place(arm.elbow), place(arm.wrist));
  const Posture in = waving(body, start, side, arm, kInward, wishes.where());
  const Posture out = waving(body, start, side, arm, kOutward, wishes.where());
  const std::uint32_t times = wishes.count("times", 3, 1000);
  const double seconds = wishes.number("seconds", 0.5, {0.1, 60});
  Gesture gesture(scene, {arm.shoulder, arm.elbow, arm.wrist});
  gesture.key(scene.at, start, kIn);
  gesture.key(frame_after(scene, kRaise / 2), half_way(start, out), kOut);
  for (std::uint32_t time = 0; time < times; ++time) {
    gesture.key(frame_after(scene, kRaise + seconds * time), out, kBoth);
    gesture.key(frame_after(scene, kRaise + seconds * (time + 0.5)), in, kBoth);
  }
  const double end = kRaise + seconds * times;
  gesture.key(frame_after(scene, end), out, kIn);
  gesture.key(frame_after(scene, end + kRaise / 2), half_way(start, out), kOut);
  gesture.key(frame_after(scene, end + kRaise), start, kLinear);
  return gesture.motion();
}

}  // namespace mars::host
