#include "host/content/animator/motion/goals/gesture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/curve.h"
#include "host/content/animator/motion/gaits/gait.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/body/reach.h"
#include "host/content/animator/motion/body/stance.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kEnough = 1;                   // degrees that a nod may fall short
constexpr double kOff = 0.1;                    // of the arm's length, that a waving hand may be off its place
constexpr double kRaise = 0.5;                  // seconds
constexpr double kGestureTolerance = 0.1;       // degrees between keys
constexpr double kInward = -14, kOutward = 34;  // degrees of the forearm from upright

// Postures of some joints at some moments. The numbers of a pose go straight from moment to moment, so that
// they keep within limits all the way: joints that turn between far keys would not.
class Gesture {
 public:
  Gesture(const Scene& scene, std::vector<std::size_t> joints) : scene_(scene), joints_(std::move(joints)) {}

  // `seconds` from the start; slowly there and on.
  void at(double seconds, const Posture& posture) {
    moments_.push_back({static_cast<std::uint32_t>(std::round(scene_.frames(seconds))), posture});
  }

  Motion motion() const {
    const std::uint32_t last = moments_.back().frame, end = scene_.last_after(last);
    std::vector<animator::ActorKey> keys(last + 1);
    for (std::uint32_t frame = 0; frame <= last; ++frame) {
      keys[frame].frame = scene_.at + frame;
      keys[frame].ease = animator::kLinear;
    }
    for (const std::size_t joint : joints_) add(scene_.model().joints[joint], numbers_of(joint, last), keys);
    std::erase_if(keys, [](const animator::ActorKey& key) { return key.pose.empty(); });
    return {keys, end, ""};
  }

 private:
  struct Moment {
    std::uint32_t frame;
    Posture posture;
  };

  std::vector<glm::dvec3> numbers_of(std::size_t joint, std::uint32_t last) const {
    std::vector<glm::dvec3> numbers;
    std::size_t from = 0;
    for (std::uint32_t frame = 0; frame <= last; ++frame) {
      while (from + 2 < moments_.size() && frame >= moments_[from + 1].frame) ++from;
      const Moment &a = moments_[from], &b = moments_[from + 1];
      const double part = smooth(a.frame, std::max(b.frame, a.frame + 1), frame);
      numbers.push_back(
          two_digits(scene_.model().joints[joint], glm::mix(a.posture.pose[joint], b.posture.pose[joint], part)));
    }
    return numbers;
  }

  static void add(const modeler::Joint& joint, const std::vector<glm::dvec3>& numbers,
                  std::vector<animator::ActorKey>& keys) {
    choose_keys(
        numbers.size(),
        [&](std::size_t a, std::size_t b, std::size_t at) {
          return strays(joint, numbers[a], numbers[b], double(at - a) / double(b - a), numbers[at], kGestureTolerance);
        },
        [&](std::size_t at) { keys[at].pose[joint.name] = numbers[at]; });
  }

  const Scene& scene_;
  std::vector<std::size_t> joints_;
  std::vector<Moment> moments_;
};

// ---- Nodding

// Bends a joint forward by as many degrees as it can of those wanted; returns how many.
double bend(const Body& body, std::size_t joint, double degrees, Posture& posture) {
  if (joint == modeler::kNone) return 0;
  const glm::dmat3 from = modeler::orientation(body.model->joints[joint], posture.pose[joint]);
  const glm::dmat3 now = glm::transpose(body.axes) * from * body.axes;
  posture.pose[joint] = numbers_for(body, joint, now * canonical_turn(0, degrees, 0), posture.pose[joint]);
  return glm::degrees(
      animator::turn_between(from, modeler::orientation(body.model->joints[joint], posture.pose[joint])).angle);
}

Posture nodded(const Body& body, const Posture& start, std::size_t neck, std::size_t head, double depth,
               const Arguments& arguments) {
  Posture down = start;
  double by_neck = bend(body, neck, head == modeler::kNone ? depth : depth / 2, down);
  const double by_head = bend(body, head, depth - by_neck, down);
  if (neck != modeler::kNone) {
    down.pose[neck] = start.pose[neck];
    by_neck = bend(body, neck, depth - by_head, down);
  }
  const double left = depth - by_neck - by_head;
  if (left > kEnough)
    arguments.refuse("depth",
                     "is " + document::shown(depth) + " degrees, but " +
                         (neck == modeler::kNone ? "" : "'" + body.joint_name(neck) + "'") +
                         (neck == modeler::kNone || head == modeler::kNone ? "" : " and ") +
                         (head == modeler::kNone ? "" : "'" + body.joint_name(head) + "'") + " can bend " +
                         document::shown(std::floor(depth - left)) + " from where they are",
                     "nod less, or widen the joint's limits in its model");
  return down;
}

// ---- Waving

struct Arm {
  std::size_t shoulder, elbow, wrist;  // the wrist may be kNone
  double upper, fore;
};

Posture waving(const Body& body, const Posture& start, modeler::Side side, const Arm& arm, double outward,
               const std::string& where) {
  Posture posture = start;
  const double s = sign_of(side), tilt = glm::radians(outward);
  const glm::dmat3 facing = canonical_turn(0, 0, body.heading_of(start));
  const glm::dvec3 shoulder = frame_in(*body.model, start, arm.shoulder).place;
  const glm::dvec3 elbow = shoulder + arm.upper * (facing * glm::normalize(glm::dvec3(0.22, s, -0.05)));
  const glm::dvec3 wrist =
      elbow + arm.fore * (facing * glm::normalize(glm::dvec3(0.12, s * elementary::sin(tilt), elementary::cos(tilt))));
  posture.pose[arm.shoulder] =
      numbers_for(body, arm.shoulder, hanging_shoulder(body, side, {s * 95, 0, s * 80}), start.pose[arm.shoulder]);
  posture.pose[arm.elbow] = numbers_for(body, arm.elbow, hanging_elbow(body, side, {0, -80, 0}), start.pose[arm.elbow]);
  const std::size_t joints[] = {arm.shoulder, arm.elbow};
  std::vector<Goal> goals{{.joint = arm.elbow, .place = elbow}};
  if (arm.wrist == modeler::kNone) {
    // The forearm, drawn as the upper arm goes on, lies across all that is across its way.
    const Posture drawn = drawn_posture(*body.model);
    const glm::dvec3 along = glm::normalize(frame_in(*body.model, drawn, arm.elbow).place -
                                            frame_in(*body.model, drawn, arm.shoulder).place);
    for (const glm::dvec3& across : {facing[0], facing[1]})
      goals.push_back(
          {.joint = arm.elbow,
           .turn_weight = arm.fore,
           .direction = along,
           .across = glm::normalize(across - glm::dot(across, wrist - elbow) / arm.fore / arm.fore * (wrist - elbow))});
  } else {
    posture.pose[arm.wrist] = numbers_for(body, arm.wrist, glm::dmat3(1), start.pose[arm.wrist]);
    goals.push_back({.joint = arm.wrist, .place = wrist});
  }
  reach(*body.model, posture, joints, goals);
  const Goal& end = arm.wrist == modeler::kNone ? goals.front() : goals.back();
  if (glm::distance(frame_in(*body.model, posture, end.joint).place, *end.place) > kOff * (arm.upper + arm.fore))
    throw Failure("cannot raise its " + std::string(side == modeler::Side::left ? "left" : "right") + " hand to wave",
                  "actor '" + body.name + "', " + where,
                  "widen the limits of '" + body.joint_name(arm.shoulder) + "' or '" + body.joint_name(arm.elbow) +
                      "' in its model, or take the other hand");
  return posture;
}

}  // namespace

Motion nod(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  const Body body = body_without_legs(scene.model(), scene.actor.name);
  const std::size_t neck = body.find(modeler::Trunk::neck);
  const std::size_t head =
      neck == modeler::kNone ? needed(body, modeler::Trunk::head, "nod") : body.find(modeler::Trunk::head);
  const Posture start = posture_of(scene);
  const Posture down = nodded(body, start, neck, head, arguments.number("depth", 24, {0.1, 120}), arguments);
  std::vector<std::size_t> joints{neck, head};
  std::erase(joints, modeler::kNone);
  const std::uint32_t times = arguments.count("times", 2, 1000);
  const double seconds = arguments.number("seconds", 0.6, {0.1, 60});
  Gesture gesture(scene, joints);
  for (std::uint32_t time = 0; time < times; ++time) {
    gesture.at(seconds * time, start);
    gesture.at(seconds * (time + 0.45), down);
  }
  gesture.at(seconds * times, start);
  return gesture.motion();
}

Motion wave(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  const Body body = body_without_legs(scene.model(), scene.actor.name);
  constexpr std::string_view hands[] = {"left", "right"};
  const modeler::Side side = kSides[arguments.choice("hand", 1, hands)];
  Arm arm{needed(body, modeler::Limb::shoulder, side, "wave"), needed(body, modeler::Limb::elbow, side, "wave"),
          body.find(modeler::Limb::wrist, side), 0, 0};
  const Posture start = posture_of(scene);
  const auto place = [&](std::size_t joint) { return frame_in(scene.model(), start, joint).place; };
  arm.upper = glm::distance(place(arm.shoulder), place(arm.elbow));
  arm.fore = arm.wrist == modeler::kNone ? arm.upper : glm::distance(place(arm.elbow), place(arm.wrist));
  const Posture in = waving(body, start, side, arm, kInward, arguments.where());
  const Posture out = waving(body, start, side, arm, kOutward, arguments.where());
  const std::uint32_t times = arguments.count("times", 3, 1000);
  const double seconds = arguments.number("seconds", 0.5, {0.1, 60});
  std::vector<std::size_t> joints{arm.shoulder, arm.elbow, arm.wrist};
  std::erase(joints, modeler::kNone);
  Gesture gesture(scene, joints);
  gesture.at(0, start);
  for (std::uint32_t time = 0; time < times; ++time) {
    gesture.at(kRaise + seconds * time, out);
    gesture.at(kRaise + seconds * (time + 0.5), in);
  }
  gesture.at(kRaise + seconds * times, out);
  gesture.at(2 * kRaise + seconds * times, start);
  return gesture.motion();
}

}  // namespace mars::motion
