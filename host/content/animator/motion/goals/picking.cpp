#include "host/content/animator/motion/goals/picking.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <glm/trigonometric.hpp>
#include <map>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/animator/motion/body/crouch.h"
#include "host/content/animator/motion/body/curve.h"
#include "host/content/animator/motion/gaits/gait.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/body/pull.h"
#include "host/content/animator/motion/goals/grasp.h"
#include "host/content/animator/motion/scene/rehearsal.h"
#include "host/content/animator/motion/scene/target.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr Parameter kPickSeconds{
    "seconds", "S", "down and up again; default: 1.2, more if the figure bends down or has fingers to close", "2.5"};
constexpr Parameter kPick[] = {{"what", "ACTOR", "the actor that the figure picks up; required", "ball"},
                               {"hand", "SIDE", "left or right; default: the nearer one", "left"},
                               kPickSeconds};
constexpr Parameter kPut[] = {{"to", "X Y Z", "the place at which the thing stands or lies; required", "1.2 -0.4 2.1"},
                              {"what", "ACTOR", "the thing; default: what the hand holds", "ball"},
                              kPickSeconds};

constexpr double kSeconds0 = 1.2, kSecondsDown = 1.25;  // and so much more for the lowest
constexpr double kSecondsGrip = 0.25;                   // while fingers close or open and the hand waits
constexpr int kDepths = 24;                             // tries from upright to the lowest
constexpr double kStretch = 0.93;                       // of the arm, that it likes to be stretched to
constexpr double kFarFromThing = 0.002;                 // of the arm: what is nearer is there
constexpr double kClearOfThing = 0.35;                  // of the arm, from where a hand goes straight to the thing
constexpr double kMostHandTwist = 50;                   // degrees
constexpr double kRelaxing = 0.4;                       // of the way back, from where fingers are as they hang
constexpr double kOpening[] = {0.15, 0.75};             // of the way to the thing: meanwhile fingers stretch

constexpr std::string_view kHands[] = {"left", "right"};

// A hand's place in the world for every frame, and the postures that lead there and back.
class Handling {
 public:
  Handling(const Scene& scene, const Body& body, const Hand& hand, const glm::dvec3& held, const glm::dvec3& to)
      : scene_(scene),
        body_(body),
        hand_(hand),
        held_(held),
        to_(to),
        start_(posture_of(scene)),
        crouch_(body, start_, scene.where()),
        chain_(chain_of(*body.model, hand.end, Extent::trunk)) {
    twist_ = twist();
    find();
  }

  double depth() const { return depth_; }

  // From the start down to the place, within that number of frames.
  std::vector<Posture> there(int frames) const {
    std::vector<Posture> postures;
    Posture posture = start_;
    for (int frame = 0; frame <= frames; ++frame) {
      const double part = smooth(0, frames, frame);
      blend(start_, part, posture);
      if (frame == frames) posture = contact_;
      if (frame > 0 && frame < frames) lead(1 - double(frame) / frames, posture);
      postures.push_back(posture);
    }
    return postures;
  }

  // And up from there, to the arm's pose of `end`.
  std::vector<Posture> back(int frames, const Posture& end) const {
    std::vector<Posture> postures;
    Posture posture = contact_;
    for (int frame = 0; frame <= frames; ++frame) {
      const double part = smooth(0, frames, frames - frame);
      blend(end, part, posture);
      if (frame == 0) posture = contact_;
      if (frame > 0 && frame < frames) lead(double(frame) / frames, posture);
      postures.push_back(posture);
    }
    return postures;
  }

 private:
  glm::dmat3 facing() const { return canonical_turn(0, 0, body_.heading_of(start_)); }

  // Of the trunk, towards what is beside.
  double twist() const {
    const glm::dvec3 way = glm::transpose(facing()) * (to_ - frame_in(*body_.model, start_, body_.pelvis).place);
    const double bearing = glm::degrees(elementary::atan2(way.y, std::max(way.x, 0.3 * hand_.length())));
    return std::clamp(bearing + sign_of(hand_.side) * -12, -kMostHandTwist, kMostHandTwist);
  }

  // The palm comes from above to what is low, from outside to what is as high as the chest.
  glm::dvec3 side_of_thing(const Posture& posture) const {
    const double shoulder = frame_in(*body_.model, posture, hand_.shoulder).place.z;
    const double floor = body_.floor_under(start_);
    const double high = smooth(0.25, 0.8, (to_.z - floor) / std::max(1e-9, shoulder - floor));
    const glm::dvec3 outward = facing()[1] * sign_of(hand_.side);
    return glm::normalize((1 - high) * glm::dvec3(0, 0, 1) + (0.35 + high) * outward - 0.15 * facing()[0]);
  }

  Pull to(const glm::dvec3& place, const Posture& posture) const {
    const glm::dvec3 side = side_of_thing(posture);
    const glm::dvec3 along = place - frame_in(*body_.model, posture, hand_.shoulder).place + facing()[0];
    const glm::dvec3 fingers = along - glm::dot(along, side) * side;
    return {held_, place, hand_turn(hand_, -side, glm::normalize(fingers))};
  }

  // The least bend with which the arm reaches it. Where limits end the bend before, back and shoulder girdle go on.
  void find() {
    double least = 1e300;
    std::optional<Posture> deepest;
    for (int i = 0; i <= kDepths; ++i) {
      Posture posture = start_;
      depth_ = double(i) / kDepths;
      try {
        crouch_.take(depth_, twist_ * std::min(1.0, 3 * depth_ + 0.4), posture);
      } catch (const Failure&) {
        if (deepest && reaches_from(*deepest, double(i - 1) / kDepths)) return;
        break;
      }
      deepest = posture;
      const double far = glm::distance(frame_in(*body_.model, posture, hand_.shoulder).place, to_);
      if (far > kStretch * hand_.length() + glm::distance(held_, hand_.grip) && i < kDepths) continue;
      contact_ = posture;
      const double left = pull(*body_.model, posture, contact_, chain_, to(to_, posture));
      least = std::min(least, left);
      if (left > kFarFromThing * hand_.length()) continue;
      crouched_ = posture;
      return;
    }
    fail(least);
  }

  bool reaches_from(const Posture& posture, double depth) {
    depth_ = depth;
    crouched_ = contact_ = posture;
    return pull(*body_.model, posture, contact_, chain_, to(to_, posture)) <= kFarFromThing * hand_.length();
  }

  [[noreturn]] void fail(double missing) const {
    const Stance& stance = crouch_.standing();
    const glm::dvec3 feet = 0.5 * (stance.feet[0].ankle + stance.feet[1].ankle);
    glm::dvec3 way = to_ - feet;
    way.z = 0;
    const double far = glm::length(way), near = 0.5 * hand_.length();
    // Beside the thing, but not so far that a short way there would turn the figure away from it.
    const double beside = 0.2 * hand_.length() * std::clamp((far - near) / (2 * near), 0.0, 1.0);
    const glm::dvec3 across = glm::dvec3(-way.y, way.x, 0) * (sign_of(hand_.side) / std::max(far, 1e-9));
    const glm::dvec3 place = far > near ? to_ - (near / far) * way - beside * across : feet;
    const auto text = [](double value) { return document::shown(std::round(value * 100) / 100 + 0.0); };
    throw Failure("its " + std::string(kHands[index_of(hand_.side)]) + " hand cannot reach " + text(to_.x) + " " +
                      text(to_.y) + " " + text(to_.z) +
                      (missing < 1e100 ? ": " + text(missing) + " are missing" : ", " + text(far) + " away"),
                  scene_.where(),
                  far > near ? "let it walk there first: walk to " + text(place.x) + " " + text(place.y)
                             : "let it step back or turn first, or take the other hand");
  }

  // The body bent by its share, arms and trunk so far on the way from `from` to the contact.
  void blend(const Posture& from, double part, Posture& posture) const {
    Posture bent = posture;
    for (const std::size_t joint : body_.between()) bent.pose[joint] = start_.pose[joint];
    crouch_.take(depth_ * part, twist_ * std::min(1.0, 3 * depth_ + 0.4) * part, bent);
    posture = bent;
    for (const std::size_t joint : chain_.trunk)
      posture.pose[joint] = clamped(joint, bent.pose[joint] + part * (contact_.pose[joint] - crouched_.pose[joint]));
    for (const std::size_t joint : chain_.joints)
      posture.pose[joint] = glm::mix(from.pose[joint], contact_.pose[joint], part);
  }

  glm::dvec3 clamped(std::size_t joint, glm::dvec3 pose) const {
    for (int axis = 0; axis < 3; ++axis) {
      const modeler::Limits& limits = body_.model->joints[joint].limits[axis];
      pose[axis] = std::clamp(pose[axis], limits.lower, limits.upper);
    }
    return pose;
  }

  // Near the thing the hand goes straight: `left` is what is left of the way, 1 to 0.
  void lead(double left, Posture& posture) const {
    const double weight = 1 - smooth(0.1, 0.7, left);
    if (weight <= 0) return;
    const modeler::Axes frame = frame_in(*body_.model, posture, hand_.end);
    const glm::dvec3 is = frame.turn * held_ + frame.place;
    const double clear = kClearOfThing * hand_.length() * smooth(0, 0.8, left);
    const glm::dvec3 from = glm::normalize(side_of_thing(contact_) + glm::dvec3(0, 0, 0.7));
    const glm::dvec3 place = glm::mix(is, to_ + clear * from, weight);
    const Posture rest = posture;
    const Chain arm = chain_of(*body_.model, hand_.end);
    pull(*body_.model, rest, posture, arm, {held_, place});
  }

  const Scene& scene_;
  const Body& body_;
  const Hand& hand_;
  glm::dvec3 held_, to_;
  Posture start_;
  Crouch crouch_;
  Chain chain_;
  double depth_ = 0, twist_ = 0;
  Posture crouched_, contact_;  // as it bends, and with the hand there
};

Posture with(const Body& body, const Posture& start, const std::map<std::size_t, glm::dmat3>& turns) {
  Posture posture = start;
  for (const auto& [joint, turn] : turns) posture.pose[joint] = numbers_for(body, joint, turn, posture.pose[joint]);
  return posture;
}

// Frames down, while the hand waits for its fingers, and up.
struct Timing {
  int down, wait, up;
};

Timing timing_of(const Scene& scene, double depth, bool has_fingers) {
  const double grip = has_fingers ? kSecondsGrip : 0;
  const double seconds = scene.arguments.number("seconds", kSeconds0 + kSecondsDown * depth + grip, {0.1, 60});
  const int frames = static_cast<int>(std::max(2.0, std::round(scene.frames(seconds))));
  scene.last_after(frames);
  const int wait = std::min(static_cast<int>(std::round(scene.frames(grip))), frames / 4);
  const int down = (frames - wait) / 2;
  return {down, wait, frames - wait - down};
}

modeler::Side nearer_hand(const Scene& scene, const Body& body, const glm::dvec3& place) {
  if (scene.arguments.has("hand")) return kSides[scene.arguments.choice("hand", 1, kHands)];
  const Posture posture = posture_of(scene);
  const glm::dvec3 way = place - frame_in(*body.model, posture, body.pelvis).place;
  const glm::dvec3 left = canonical_turn(0, 0, body.heading_of(posture))[1];
  return glm::dot(way, left) > 0.1 * body.leg_length() ? modeler::Side::left : modeler::Side::right;
}

void add(Rehearsal& rehearsal, const Body& body, const Fingers& fingers, const std::vector<Posture>& postures) {
  const std::uint32_t first = rehearsal.at();
  std::vector<std::size_t> joints = body.joints();
  for (const auto& [joint, numbers] : fingers) joints.push_back(joint);
  rehearsal.add({keys_of(body, joints, postures, first), first + std::uint32_t(postures.size()) - 1});
}

// The fingers' way from `from` to `to` between two of the postures; before and after these they stay.
void move_fingers(const Fingers& from, const Fingers& to, double first, double last, std::vector<Posture>& postures) {
  for (std::size_t i = 0; i < postures.size(); ++i)
    blend(from, to, smooth(first, std::max(last, first + 1e-9), double(i)), postures[i]);
}

// The hand stays where it is for `frames` frames, while its fingers move.
void wait(Rehearsal& rehearsal, const Body& body, const Fingers& from, const Fingers& to, int frames,
          const Posture& posture) {
  if (frames == 0) return;
  std::vector<Posture> postures(static_cast<std::size_t>(frames) + 1, posture);
  move_fingers(from, to, 0, frames, postures);
  add(rehearsal, body, from, postures);
}

// The thing moves along with the joint from the frame on.
void attach_to(std::size_t joint, std::size_t thing, std::uint32_t frame, const Scene& scene, Rehearsal& rehearsal) {
  const std::size_t figure = std::size_t(&scene.actor - scene.film.actors.data());
  animator::JointFrames frames(rehearsal.film());
  const modeler::Axes held = animator::seen_from(frames.frame_of(figure, joint, frame), frames.root_of(thing, frame));
  rehearsal.attach(thing, frame,
                   {scene.actor.name, scene.model().joints[joint].name, animator::rounded(held.place),
                    animator::rounded(canonical_degrees(held.turn))});
}

}  // namespace

std::span<const Parameter> pick_parameters() { return kPick; }
std::span<const Parameter> put_parameters() { return kPut; }

std::map<std::size_t, glm::dmat3> carrying(const Body& body, const Hand& hand) {
  const double s = sign_of(hand.side);
  std::map<std::size_t, glm::dmat3> turns{{hand.shoulder, hanging_shoulder(body, hand.side, {s * 14, -8, 0})},
                                          {hand.elbow, hanging_elbow(body, hand.side, {0, -70, s * 60})}};
  if (hand.end != hand.elbow) turns[hand.end] = glm::dmat3(1);
  return turns;
}

Holding holding_of(const Scene& scene, const Body& body) {
  const auto wanted = target_of(scene, "what");
  std::vector<Holding> held;
  for (std::size_t actor = 0; actor < scene.film.actors.size(); ++actor) {
    const animator::Attachment* by = animator::attachment_at(scene.film.actors[actor], scene.at);
    if (!by || scene.film.actors[by->actor].name != scene.actor.name || (wanted && wanted->actor != actor)) continue;
    for (const modeler::Side side : kSides)
      for (const modeler::Limb limb : {modeler::Limb::wrist, modeler::Limb::elbow})
        if (by->joint != modeler::kNone && body.find(limb, side) == by->joint)
          held.push_back({hand_of(body, side, std::string(scene.action)), actor});
  }
  if (held.size() == 1) return held.front();
  const std::string what = wanted ? "'" + scene.film.actors[wanted->actor].name + "'" : "anything";
  if (held.empty())
    throw Failure("does not hold " + what + " in a hand at frame " + std::to_string(scene.at), scene.where(),
                  "let it pick it up first: pick what ACTOR");
  throw Failure("holds several things", scene.where(), "say which: what ACTOR");
}

Motion pick(const Scene& scene) {
  const auto what = target_of(scene, "what");
  if (!what) scene.arguments.refuse("what", "is missing", "say what it picks up: what ACTOR");
  if (scene.film.actors[what->actor].name == scene.actor.name)
    scene.arguments.refuse("what", "is the figure itself", "name another actor");
  require_two_legs(scene.model(), scene.actor.name, "pick");
  const Body body = body_of(scene.model(), scene.actor.name, "pick");
  // Where it is when the hand is there, and so when that is.
  Timing timing = timing_of(scene, 0.5, true);
  for (int tries = 0;; ++tries) {
    const std::uint32_t contact = scene.at + std::uint32_t(timing.down);
    const Block block = block_of(scene, {what->actor}, contact);
    const Hand hand = hand_of(body, nearer_hand(scene, body, block.middle), "pick");
    const double radius = std::min({block.half.x, block.half.y, block.half.z});
    const std::vector<Digit> digits = digits_of(*body.model, hand, hand.around(radius));
    const Handling handling(scene, body, hand, hand.around(radius), block.middle);
    const Timing needed = timing_of(scene, handling.depth(), !digits.empty());
    if (needed.down != timing.down && tries < 3) {
      timing = needed;
      continue;
    }
    if (needed.down == timing.down) timing = needed;
    const Posture start = posture_of(scene);
    const Fingers now = fingers_in(digits, start), open = open_fingers(*body.model, digits, start);
    Rehearsal rehearsal(scene);
    std::vector<Posture> there = handling.there(timing.down);
    move_fingers(now, open, kOpening[0] * timing.down, kOpening[1] * timing.down, there);
    const Solid thing(scene.film, what->actor, contact, frame_in(*body.model, there.back(), hand.end));
    const Fingers closed = closed_fingers(*body.model, digits, hand.end, start, thing);
    add(rehearsal, body, now, there);
    attach_to(hand.end, what->actor, contact, scene, rehearsal);
    wait(rehearsal, body, open, closed, timing.wait, there.back());
    std::vector<Posture> back = handling.back(timing.up, with(body, start, carrying(body, hand)));
    for (Posture& posture : back) blend(closed, closed, 1, posture);
    add(rehearsal, body, now, back);
    Motion motion = rehearsal.take();
    motion.report = "takes '" + scene.film.actors[what->actor].name + "' with '" + body.joint_name(hand.end) +
                    "' at frame " + std::to_string(contact);
    return motion;
  }
}

Motion put(const Scene& scene) {
  const auto to = scene.arguments.vector("to");
  if (!to) scene.arguments.refuse("to", "is missing", "say where: to 1 0 2");
  require_two_legs(scene.model(), scene.actor.name, "put");
  const Body body = body_of(scene.model(), scene.actor.name, "put");
  const Holding holding = holding_of(scene, body);
  const glm::dvec3 held = animator::attachment_at(scene.film.actors[holding.actor], scene.at)->place;
  const Handling handling(scene, body, holding.hand, held, *to);
  const std::vector<Digit> digits = digits_of(*body.model, holding.hand, held);
  const Timing timing = timing_of(scene, handling.depth(), !digits.empty());
  const Posture start = posture_of(scene);
  const Fingers closed = fingers_in(digits, start), open = open_fingers(*body.model, digits, start);
  Rehearsal rehearsal(scene);
  const std::vector<Posture> there = handling.there(timing.down);
  add(rehearsal, body, closed, there);
  rehearsal.attach(holding.actor, rehearsal.at(), {});
  wait(rehearsal, body, closed, open, timing.wait, there.back());
  std::vector<Posture> back = handling.back(timing.up, with(body, start, at_ease(body)));
  move_fingers(open, relaxed_fingers(*body.model, digits), kRelaxing * timing.up, timing.up, back);
  add(rehearsal, body, closed, back);
  return rehearsal.take();
}

}  // namespace mars::motion
