#include "host/content/animator/motion/goals/tossing.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/motion/body/crouch.h"
#include "host/content/animator/motion/body/curve.h"
#include "host/content/animator/motion/gaits/gait.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/laws/flight.h"
#include "host/content/animator/motion/laws/kinematic.h"
#include "host/content/animator/motion/goals/grasp.h"
#include "host/content/animator/motion/goals/picking.h"
#include "host/content/animator/motion/scene/gravity.h"
#include "host/content/animator/motion/scene/rehearsal.h"
#include "host/content/animator/motion/scene/target.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr Parameter kToss[] = {
    {"to", "X Y Z", "the place to which the thing flies; if the floor is in the way, it flies above the place",
     "4 -1 0"},
    {"velocity", "X Y Z", "instead of to: the velocity with which the thing leaves the hand, in units a second",
     "4 0 5"},
    {"what", "ACTOR", "the thing; default: what the hand holds", "ball"},
    {"flight", "S", "seconds to the place; default: as few as the least speed needs", "1.2"},
    {"gravity", "G", kGravityMeaning, "28.4"},
    {"floor", "Z", "height of the floor on which the thing bounces; default: 0", "0.5"},
    {"restitution", "N", "part of the upward speed that an impact leaves, 0 to 0.99; default: 0.7", "0.5"},
    {"friction", "N", "part of the speed along the floor that an impact removes, 0 to 1; default: 0.1", "0.3"},
    {"spin", "X Y Z", "degrees a second about the world's axes; default: none", "0 360 0"}};

constexpr double kSwingBack = 0.55, kSwingThrough = 0.3,
                 kSwingRest = 0.8;        // seconds: back, past the release, and to rest
constexpr double kBackward = 42;          // degrees that the arm swings back
constexpr double kFollow = 32;            // degrees beyond the release
constexpr double kDip = 0.16;             // of the deepest bend, while it swings
constexpr double kMostThrowBearing = 50;  // degrees from where the figure looks
constexpr double kQuickest = 0.12;        // seconds of the swing forward
constexpr double kLetGo = 0.1;            // seconds in which fingers stretch

struct Throw {
  glm::dvec3 velocity;
  std::uint32_t frames;  // to the place
};

// The slowest throw that gets there, or the one that takes the seconds asked for; it arrives at a whole frame.
Throw throw_to(const glm::dvec3& from, const glm::dvec3& to, double gravity, double rate,
               const std::optional<double>& seconds) {
  const glm::dvec3 way = to - from;
  const double far = glm::length(way);
  const double speed2 = gravity * (way.z + far);
  // The slowest takes sqrt(2 far / g): it halves the angle between the way and straight up.
  const double slowest = speed2 > 0 && gravity > 0 ? std::sqrt(2 * far / gravity) : 1;
  const double frames = std::max(1.0, std::round(rate * seconds.value_or(slowest)));
  const double time = frames / rate;
  return {way / time + glm::dvec3(0, 0, 0.5 * gravity * time), static_cast<std::uint32_t>(frames)};
}

class ArmSwing {
 public:
  ArmSwing(const Scene& scene, const Body& body, const Holding& holding)
      : scene_(scene),
        body_(body),
        hand_(holding.hand),
        thing_(holding.actor),
        start_(posture_of(scene)),
        crouch_(body, start_, scene.where()),
        digits_(digits_of(*body.model, hand_, animator::attachment_at(scene.film.actors[thing_], scene.at)->place)),
        open_(open_fingers(*body.model, digits_, start_)),
        relaxed_(relaxed_fingers(*body.model, digits_)) {}

  // That it moves.
  std::vector<std::size_t> joints() const {
    std::vector<std::size_t> joints = body_.joints();
    for (const auto& [joint, numbers] : open_) joints.push_back(joint);
    return joints;
  }

  double heading() const { return body_.heading_of(start_); }

  // Back, forward to the release, through: an angle of the arm forward from hanging, at a moment of the swing.
  struct Shape {
    int back, forward, through, rest;  // frames
    double release;                    // degrees
    double yaw;                        // degrees, of the target from where the figure looks
  };

  std::vector<Posture> until_release(const Shape& shape) const {
    std::vector<Posture> postures;
    Posture posture = start_;
    for (int frame = 0; frame <= shape.back + shape.forward; ++frame) {
      const double back = smooth(0, shape.back, frame);
      const double u = std::max(0.0, double(frame - shape.back) / shape.forward);
      const double angle = -kBackward * back + (kBackward + shape.release) * u * u;
      bend(frame <= shape.back ? kDip * back : kDip * (1 - smooth(0, 1, u)), -14 * back + 26 * smooth(0, 1, u),
           posture);
      swing(angle, shape.yaw, frame < shape.back ? smooth(0, 0.6 * shape.back, frame) : 1, posture);
      postures.push_back(posture);
    }
    return postures;
  }

  std::vector<Posture> after_release(const Shape& shape, const Posture& released) const {
    std::vector<Posture> postures;
    Posture posture = released, followed = released;
    const double speed = 2 * (kBackward + shape.release) / shape.forward;  // degrees a frame
    const double most = std::min(kFollow, 0.5 * speed * shape.through);
    Posture rest = start_;
    for (const auto& [joint, turn] : at_ease(body_)) {
      const bool of_arm = joint == hand_.shoulder || joint == hand_.elbow || joint == hand_.end;
      if (of_arm) rest.pose[joint] = numbers_for(body_, joint, turn, start_.pose[joint]);
    }
    for (int frame = 0; frame <= shape.through + shape.rest; ++frame) {
      const double part = std::min(1.0, double(frame) / shape.through);
      const double down = smooth(shape.through, shape.through + shape.rest, frame);
      bend(0, 12 * (1 - down), posture);
      if (frame <= shape.through) {
        swing(shape.release + most * part * (2 - part), shape.yaw, 1, posture);
        followed = posture;
      } else {
        for (const std::size_t joint : hand_.joints())
          posture.pose[joint] = glm::mix(followed.pose[joint], rest.pose[joint], down);
      }
      if (frame == 0) posture = released;
      let_go(frame, shape, released, posture);
      postures.push_back(posture);
    }
    return postures;
  }

  // Where the thing is in a posture.
  glm::dvec3 thing_in(const Posture& posture) const {
    const animator::Attachment& held = *animator::attachment_at(scene_.film.actors[thing_], scene_.at);
    const modeler::Axes frame = frame_in(*body_.model, posture, hand_.end);
    return frame.turn * held.place + frame.place;
  }

 private:
  void bend(double depth, double twist, Posture& posture) const {
    Posture bent = posture;
    crouch_.take(depth, sign_of(hand_.side) * -twist * -1, bent);
    for (const std::size_t joint : hand_.joints()) bent.pose[joint] = posture.pose[joint];
    posture = bent;
  }

  // Fingers stretch at once, and relax while the arm goes down.
  void let_go(int frame, const Shape& shape, const Posture& released, Posture& posture) const {
    const double stretched = smooth(0, std::max(1.0, scene_.frames(kLetGo)), frame);
    blend(fingers_in(digits_, released), open_, stretched, posture);
    if (frame > shape.through)
      blend(open_, relaxed_, smooth(shape.through, shape.through + shape.rest, frame), posture);
  }

  // `share` of the way from where the arm was.
  void swing(double angle, double yaw, double share, Posture& posture) const {
    const double s = sign_of(hand_.side);
    const auto pose = [&](std::size_t joint, const glm::dmat3& turn) {
      const glm::dvec3 wanted = numbers_for(body_, joint, turn, posture.pose[joint]);
      posture.pose[joint] = glm::mix(start_.pose[joint], wanted, share);
    };
    pose(hand_.shoulder, canonical_turn(0, 0, yaw) * hanging_shoulder(body_, hand_.side, {0, 0, 0}) *
                             canonical_turn(s * 14, -angle, 0));
    pose(hand_.elbow, hanging_elbow(body_, hand_.side, {0, -12, s * 70}));
    if (hand_.end != hand_.elbow) pose(hand_.end, glm::dmat3(1));
  }

  const Scene& scene_;
  const Body& body_;
  const Hand& hand_;
  std::size_t thing_;
  Posture start_;
  Crouch crouch_;
  std::vector<Digit> digits_;
  Fingers open_, relaxed_;
};

std::string text(double value) { return document::shown(std::round(value * 100) / 100 + 0.0); }

std::string numbers(const glm::dvec3& v) {
  const auto exact = [](double value) { return document::shown(animator::rounded(value)); };
  return exact(v.x) + " " + exact(v.y) + " " + exact(v.z);
}

void add(Rehearsal& rehearsal, const Body& body, const ArmSwing& swing, const std::vector<Posture>& postures) {
  const std::uint32_t first = rehearsal.at();
  rehearsal.add({keys_of(body, swing.joints(), postures, first), first + std::uint32_t(postures.size()) - 1});
}

}  // namespace

std::span<const Parameter> toss_parameters() { return kToss; }

Motion toss(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  const auto to = arguments.vector("to"), velocity = arguments.vector("velocity");
  if (to && velocity) arguments.refuse("to", "stands beside velocity", "give one of them");
  if (!to && !velocity) arguments.refuse("to", "is missing", "say where it flies: to 4 0 0, or with which velocity");
  require_two_legs(scene.model(), scene.actor.name, "toss");
  const Body body = body_of(scene.model(), scene.actor.name, "toss");
  const Holding holding = holding_of(scene, body);
  const double gravity = arguments.number("gravity", gravity_in(scene.film), {1e-6, 1e9});
  const double floor = arguments.number("floor", 0, {-document::kFarthest, document::kFarthest});
  const ArmSwing swing(scene, body, holding);

  const Block block = block_of(scene, {holding.actor}, scene.at);
  const glm::dvec3 now = animator::state_at(scene.film, holding.actor, scene.at).root.place;
  const double radius = std::min({block.half.x, block.half.y, block.half.z});
  const double below = now.z - block.middle.z + radius;
  glm::dvec3 target = to.value_or(now);
  target.z = std::max(target.z, floor + below);
  const auto flight = arguments.number("flight", {0.01, 600});
  const auto thrown = [&](const glm::dvec3& from) {
    return to ? throw_to(from, target, gravity, scene.film.rate, flight) : Throw{*velocity, 0};
  };
  Throw released = thrown(now);
  const double bearing = std::remainder(
      glm::degrees(elementary::atan2(released.velocity.y, released.velocity.x)) - swing.heading(), 360.0);
  const bool level = elementary::hypot(released.velocity.x, released.velocity.y) > 1e-6;
  if (level && std::abs(bearing) > kMostThrowBearing)
    throw Failure("would toss " + text(std::abs(bearing)) + " degrees to its " + (bearing > 0 ? "left" : "right"),
                  scene.where(),
                  "let it turn there first: turn " +
                      (to ? "to " + text(target.x) + " " + text(target.y) : "by " + text(bearing)));
  const auto frames = [&](double seconds) { return std::max(2, static_cast<int>(std::round(scene.frames(seconds)))); };
  ArmSwing::Shape shape{frames(kSwingBack), 0, frames(kSwingThrough), frames(kSwingRest), 40, level ? bearing : 0};
  std::vector<Posture> postures;
  // The arm lets go where it moves as the thing shall fly, and about as fast.
  for (int round = 0; round < 3; ++round) {
    const glm::dvec3& v = released.velocity;
    shape.release = std::clamp(glm::degrees(elementary::atan2(v.z, elementary::hypot(v.x, v.y))), 5.0, 70.0);
    const double radians = glm::radians(kBackward + shape.release);
    shape.forward =
        frames(std::clamp(2 * radians * holding.hand.length() / std::max(glm::length(v), 1e-9), kQuickest, 0.6));
    postures = swing.until_release(shape);
    released = thrown(swing.thing_in(postures.back()));
  }
  scene.last_after(shape.back + shape.forward + shape.through + shape.rest);
  Rehearsal rehearsal(scene);
  add(rehearsal, body, swing, postures);
  const std::uint32_t release = rehearsal.at();
  rehearsal.attach(holding.actor, release, {});
  add(rehearsal, body, swing, swing.after_release(shape, postures.back()));

  released = thrown(animator::state_at(rehearsal.film(), holding.actor, release).root.place);
  const auto three = [](const glm::dvec3& v) {
    return std::vector{document::shown(v.x), document::shown(v.y), document::shown(v.z)};
  };
  Arguments::Values values{{"velocity", three(released.velocity)}, {"gravity", {document::shown(gravity)}}};
  for (const char* name : {"floor", "restitution", "friction", "spin"})
    if (arguments.has(name)) values[name] = arguments.values(name);
  rehearsal.perform(holding.actor, release, bounce, values);
  Motion motion = rehearsal.take();
  motion.report = "lets '" + scene.film.actors[holding.actor].name + "' go at frame " + std::to_string(release) +
                  " with velocity " + numbers(released.velocity) +
                  (released.frames ? "; there at frame " + std::to_string(release + released.frames) : "") +
                  "; it lies from frame " + std::to_string(motion.others.begin()->second.back().frame);
  return motion;
}

}  // namespace mars::motion
