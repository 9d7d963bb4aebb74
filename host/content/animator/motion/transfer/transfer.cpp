#include "host/content/animator/motion/transfer/transfer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <span>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/motion/body/reach.h"
#include "host/content/animator/motion/transfer/matching.h"
#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/elementary/elementary.h"
#include "node/wire/film.h"

namespace mars::motion {
namespace {

constexpr double kMissed = 0.05;    // degrees that a joint may be off before it counts as limited
constexpr double kOnFloor = 0.015;  // of the hips' height: a figure so near the floor of the world stands on it
constexpr double kDigits = 1e-4;    // degrees, of keys
constexpr double kMoves = 0.01;     // degrees: what turns less stands still
constexpr int kTries = 16;          // halvings of a roll
constexpr double kParallel = 1e-9;  // of directions

using modeler::kNone;

// The smallest turn that takes one direction to another.
glm::dmat3 turn_to(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis);
  if (sine < kParallel) return glm::dmat3(1);
  return modeler::rotation(axis / sine, elementary::atan2(sine, glm::dot(from, to)));
}

// An actor of a film, with its body and how it moves.
class Performer {
 public:
  Performer(const animator::Film& film, std::size_t actor)
      : film_(film), actor_(actor), body_(body_without_legs(film.model_of(actor), film.actors[actor].name)) {
    if (!film.actors[actor].matrices.empty())
      throw Failure("is moved by matrices", "actor '" + film.actors[actor].name + "'",
                    "a motion is carried between figures with keys: import it with --motion keys");
  }

  const modeler::Model& model() const { return film_.model_of(actor_); }
  const Body& body() const { return body_; }
  double rate() const { return film_.rate; }

  Posture at(std::uint32_t frame) const {
    animator::ActorState state = animator::state_at(film_, actor_, frame);
    return {state.place, state.turn, std::move(state.pose)};
  }

  // The joint that carries the rest of it along.
  std::size_t root() const { return body_.pelvis == kNone ? 0 : body_.pelvis; }

  double near_world(double floor) const { return std::abs(floor) < kOnFloor * body_.height ? 0 : floor; }

  // On which it stands at some time.
  double floor_under(std::span<const Posture> postures) const {
    if (body_.height <= 0) return 0;
    double least = 1e300;
    for (const Posture& posture : postures) least = std::min(least, body_.floor_under(posture));
    return near_world(least);
  }

  // Of a posture that stands; the world's, where that is near.
  double floor_under(const Posture& posture) const {
    return body_.height <= 0 ? 0 : near_world(body_.floor_under(posture));
  }

 private:
  const animator::Film& film_;
  std::size_t actor_;
  Body body_;
};

// What a joint's limb points along as drawn, canonical; none where it ends nothing.
std::optional<glm::dvec3> direction_of(const Body& body, modeler::Limb limb, modeler::Side side) {
  using modeler::Limb;
  const auto next = [&]() -> std::optional<Limb> {
    if (limb == Limb::hip) return Limb::knee;
    if (limb == Limb::knee) return Limb::ankle;
    if (limb == Limb::shoulder) return Limb::elbow;
    if (limb == Limb::elbow) return Limb::wrist;
    return std::nullopt;
  }();
  if (!next || body.find(limb, side) == kNone || body.find(*next, side) == kNone) return std::nullopt;
  const Posture drawn = drawn_posture(*body.model);
  const glm::dvec3 along = frame_in(*body.model, drawn, body.find(*next, side)).place -
                           frame_in(*body.model, drawn, body.find(limb, side)).place;
  const double length = glm::length(along);
  if (length <= 0) return std::nullopt;
  return glm::transpose(body.axes) * (along / length);
}

class Transfer {
 public:
  Transfer(const MotionSource& source, const animator::Film& film, std::size_t actor, std::uint32_t at)
      : source_(source),
        from_(source.film, source.actor),
        to_(film, actor),
        at_(at),
        matching_(match_joints(from_.model(), to_.model())),
        start_(to_.at(at)) {
    animator::refuse_carried(film, film.actors[actor], at, "actor '" + film.actors[actor].name + "'");
    if (matching_.joints.empty())
      throw Failure("has no joint that stands for one of '" + source.film.actors[source.actor].name + "'",
                    "actor '" + film.actors[actor].name + "'",
                    "name the limbs of both models, or give joints the same names: docs/model-format.md");
    if (from_.body().height > 0 && to_.body().height > 0) scale_ = to_.body().height / from_.body().height;
    correct_rests();
  }

  Transferred run() {
    const double step = from_.rate() / to_.rate();
    const double frames = std::floor((source_.frames.last - source_.frames.first) / step + 1e-9);
    if (at_ + frames >= wire::kMostFrames)
      throw Failure("would end at frame " + std::to_string(std::uint64_t(at_ + frames)), "the motion",
                    "begin earlier: a film has at most " + std::to_string(wire::kMostFrames) + " frames");
    std::vector<Posture> postures;
    for (std::uint32_t frame = 0; frame <= std::uint32_t(frames); ++frame)
      postures.push_back(sampled(source_.frames.first + frame * step));
    anchor(postures);
    if (!pelvis_can_follow(postures)) turn_by_actor(postures.front());
    Posture posture = start_;
    Transferred done;
    for (std::uint32_t frame = 0; frame <= std::uint32_t(frames); ++frame) {
      take(postures[frame], posture);
      done.keys.push_back(key_of(posture, at_ + frame));
    }
    done.first = at_;
    done.last = at_ + std::uint32_t(frames);
    done.by_limb = matching_.by_limb;
    done.by_name = matching_.by_name;
    done.scale = scale_;
    done.left_out = left_out();
    for (const auto& [joint, missed] : missed_) done.limited.push_back({to_.model().joints[joint].name, missed});
    std::ranges::stable_sort(done.limited, std::greater(), &Limited::degrees);
    return done;
  }

 private:
  // Arms that hang in one model and are held out in the other, legs apart: their joints are turned as drawn.
  void correct_rests() {
    correction_.assign(to_.model().joints.size(), glm::dmat3(1));
    for (const modeler::Side side : kSides) {
      for (const modeler::Limb limb :
           {modeler::Limb::hip, modeler::Limb::knee, modeler::Limb::shoulder, modeler::Limb::elbow}) {
        const auto from = direction_of(from_.body(), limb, side), to = direction_of(to_.body(), limb, side);
        if (from && to) correction_[to_.body().find(limb, side)] = turn_to(*to, *from);
      }
      const std::size_t elbow = to_.body().find(modeler::Limb::elbow, side);
      if (elbow == kNone) continue;
      for (const modeler::Limb limb : {modeler::Limb::wrist, modeler::Limb::fingers})
        if (const std::size_t joint = to_.body().find(limb, side); joint != kNone)
          correction_[joint] = correction_[elbow];
    }
    // What no limb says turns as what carries it: fingers with the hand.
    for (std::size_t joint = 0; joint < correction_.size(); ++joint) {
      const std::size_t parent = to_.model().joints[joint].parent;
      if (!to_.model().limbs.has(joint) && parent != kNone && below_wrist(joint))
        correction_[joint] = correction_[parent];
    }
  }

  bool below_wrist(std::size_t joint) const {
    return std::any_of(std::begin(kSides), std::end(kSides), [&](modeler::Side side) {
      const std::size_t wrist = to_.body().find(modeler::Limb::wrist, side);
      return wrist != kNone && joint != wrist && modeler::is_at_or_below(to_.model().joints, joint, wrist);
    });
  }

  // Where both begin, and how the one is turned against the other.
  void anchor(std::span<const Posture> postures) {
    const Posture& begin = postures.front();
    align_ = canonical_turn(0, 0, to_.body().heading_of(start_) - from_.body().heading_of(begin));
    from_place_ = frame_in(from_.model(), begin, from_.root()).place;
    to_place_ = frame_in(to_.model(), start_, to_.root()).place;
    from_place_.z = from_.floor_under(postures);
    to_place_.z = to_.floor_under(start_);
    if (from_.body().height > 0 && to_.body().height > 0) return;
    from_place_.z = frame_in(from_.model(), begin, from_.root()).place.z;
    to_place_.z = frame_in(to_.model(), start_, to_.root()).place.z;
  }

  // The source at a moment between two of its frames: places go straight on, joints by the smallest turn.
  Posture sampled(double time) {
    const double whole = std::floor(time + 1e-9), part = std::max(0.0, time - whole);
    Posture posture = from_.at(std::uint32_t(whole));
    note_moves(posture);
    if (part < 1e-9) return posture;
    const Posture next = from_.at(std::uint32_t(whole) + 1);
    const auto between = [&](const modeler::Joint& joint, const glm::dvec3& a, const glm::dvec3& b) {
      const glm::dmat3 from = modeler::orientation(joint, a);
      const animator::Turn turn = animator::turn_between(from, modeler::orientation(joint, b));
      return animator::pose_of(joint, modeler::rotation(turn.axis, part * turn.angle) * from, a);
    };
    posture.place = glm::mix(posture.place, next.place, part);
    posture.turn = between(animator::free_joint(), posture.turn, next.turn);
    for (std::size_t joint = 0; joint < posture.pose.size(); ++joint)
      if (posture.pose[joint] != next.pose[joint])
        posture.pose[joint] = between(from_.model().joints[joint], posture.pose[joint], next.pose[joint]);
    return posture;
  }

  void note_moves(const Posture& posture) {
    if (first_pose_.empty()) first_pose_ = posture.pose;
    moves_.resize(posture.pose.size());
    for (std::size_t joint = 0; joint < posture.pose.size(); ++joint)
      if (glm::distance(posture.pose[joint], first_pose_[joint]) > kMoves) moves_[joint] = true;
  }

  // The target's orientation in the world for one of the source's.
  glm::dmat3 carried(const glm::dmat3& turn) const {
    return align_ * turn * from_.body().axes * glm::transpose(to_.body().axes);
  }

  // Where only the joints of a source's figure turn it about, as in captured motion, limits of the target's pelvis may
  // be in the way.
  bool pelvis_can_follow(const std::vector<Posture>& postures) const {
    const std::size_t from = from_.body().pelvis, to = to_.body().pelvis;
    if (from == kNone || to == kNone || matching_.from_of(to) != from) return true;
    const modeler::Joint& joint = to_.model().joints[to];
    return std::ranges::all_of(postures, [&](const Posture& posture) {
      const glm::dmat3 whole = carried(actor_turn(posture)),
                       turn = carried(frame_in(from_.model(), posture, from).turn);
      const glm::dvec3 pose = animator::pose_of(joint, glm::transpose(whole) * turn, joint.rest());
      return animator::largest_excess(joint, pose) <= kMissed;
    });
  }

  void turn_by_actor(const Posture& begin) {
    turns_whole_ = true;
    const glm::dvec3 ahead = from_.body().turn_of(begin, from_.body().pelvis)[0];
    align_ = canonical_turn(0, 0, to_.body().heading_of(start_) - glm::degrees(elementary::atan2(ahead.y, ahead.x)));
  }

  void take(const Posture& from, Posture& posture) {
    const glm::dmat3 whole = turns_whole_ ? frame_in(from_.model(), from, from_.body().pelvis).turn : actor_turn(from);
    posture.turn = turn_near(carried(whole), posture.turn);
    for (const Match& match : matching_.joints) {
      if (turns_whole_ && modeler::is_at_or_below(to_.model().joints, to_.body().pelvis, match.to)) {
        posture.pose[match.to] = to_.model().joints[match.to].rest();
        continue;
      }
      const glm::dmat3 turn = carried(frame_in(from_.model(), from, match.from).turn) * to_.body().axes *
                              correction_[match.to] * glm::transpose(to_.body().axes);
      roll_forearm(match.to, turn, posture);
      turn_joint(match.to, turn, posture);
    }
    const glm::dvec3 way = frame_in(from_.model(), from, from_.root()).place - from_place_;
    posture.place += to_place_ + scale_ * (align_ * way) - frame_in(to_.model(), posture, to_.root()).place;
  }

  static glm::dvec3 turn_near(const glm::dmat3& turn, const glm::dvec3& near) {
    return animator::pose_of(animator::free_joint(), turn, near);
  }

  // Hands of many figures bend alone: what else turns them the forearm does about its own length.
  void roll_forearm(std::size_t wrist, const glm::dmat3& hand, Posture& posture) const {
    const std::vector<modeler::Joint>& joints = to_.model().joints;
    for (const modeler::Side side : kSides) {
      const std::size_t elbow = to_.body().find(modeler::Limb::elbow, side);
      if (elbow == kNone || to_.body().find(modeler::Limb::wrist, side) != wrist || joints[wrist].parent != elbow)
        continue;
      const glm::dvec3 along = glm::normalize(joints[wrist].place);
      if (can_twist(joints[wrist], along)) return;
      const glm::dmat3 wanted = glm::transpose(frame_in(to_.model(), posture, elbow).turn) * hand;
      const glm::dmat3 is = modeler::orientation(joints[wrist], within(joints[wrist], wanted, posture.pose[wrist]));
      const animator::Turn left = animator::turn_between(is, wanted);
      const double roll = 2 * elementary::atan2(glm::dot(left.axis, along) * elementary::sin(left.angle / 2),
                                                elementary::cos(left.angle / 2));
      roll_within(joints[elbow], along, roll, posture.pose[elbow]);
    }
  }

  static bool can_twist(const modeler::Joint& joint, const glm::dvec3& along) {
    const glm::dvec3 axes[] = {joint.x_axis, joint.y_axis, glm::cross(joint.x_axis, joint.y_axis)};
    int nearest = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(glm::dot(axes[axis], along)) > std::abs(glm::dot(axes[nearest], along))) nearest = axis;
    return joint.limits[nearest].free();
  }

  // As much of the roll as the limits allow.
  static void roll_within(const modeler::Joint& joint, const glm::dvec3& along, double roll, glm::dvec3& pose) {
    const glm::dmat3 turn = modeler::orientation(joint, pose);
    double good = 0, bad = 1;
    for (int tries = 0; tries < kTries; ++tries) {
      const double share = tries == 0 ? 1 : (good + bad) / 2;
      const glm::dvec3 rolled = animator::pose_of(joint, turn * modeler::rotation(along, share * roll), pose);
      const bool fits = animator::largest_excess(joint, rolled) <= animator::kAngleRounding;
      (fits ? good : bad) = share;
      if (fits) pose = animator::clamped(joint, rolled);
      if (good == 1) return;
    }
  }

  // The numbers of the turn, or what is nearest within the limits.
  static glm::dvec3 within(const modeler::Joint& joint, const glm::dmat3& turn, const glm::dvec3& near) {
    const glm::dvec3 pose = animator::pose_of(joint, turn, near);
    const bool fits = animator::largest_excess(joint, pose) <= animator::kAngleRounding;
    return animator::clamped(joint, fits ? pose : nearest_turns(joint, turn, near));
  }

  // To the orientation in the world, as nearly as its limits allow.
  void turn_joint(std::size_t number, const glm::dmat3& turn, Posture& posture) {
    const modeler::Joint& joint = to_.model().joints[number];
    const glm::dmat3 wanted = glm::transpose(socket_in(to_.model(), posture, number).turn) * turn;
    posture.pose[number] = within(joint, wanted, posture.pose[number]);
    const double off = animator::turn_between(modeler::orientation(joint, posture.pose[number]), wanted).angle;
    if (const double missed = off * 180 / std::numbers::pi; missed > kMissed)
      missed_[number] = std::max(missed_[number], missed);
  }

  animator::ActorKey key_of(const Posture& posture, std::uint32_t frame) const {
    const auto rounded = [](const glm::dvec3& value) {
      return animator::rounded(glm::round(value / kDigits) * kDigits);
    };
    animator::ActorKey key;
    key.frame = frame;
    key.ease = animator::kLinear;
    key.place = animator::rounded(posture.place);
    key.turn = rounded(posture.turn);
    for (const Match& match : matching_.joints) {
      const modeler::Joint& joint = to_.model().joints[match.to];
      if (joint.freedoms() > 0) key.pose[joint.name] = animator::clamped(joint, rounded(posture.pose[match.to]));
    }
    return key;
  }

  std::vector<std::string> left_out() const {
    std::vector<std::string> names;
    for (std::size_t joint = 0; joint < moves_.size(); ++joint)
      if (moves_[joint] && !matching_.takes(joint)) names.push_back(from_.model().joints[joint].name);
    return names;
  }

  const MotionSource& source_;
  Performer from_, to_;
  std::uint32_t at_;
  Matching matching_;
  Posture start_;  // of the target
  double scale_ = 1;
  std::vector<glm::dmat3> correction_;  // of the target's joints, canonical
  glm::dmat3 align_{1};
  bool turns_whole_ = false;                            // by the actor's turn what the pelvis of the source turns
  glm::dvec3 from_place_{0, 0, 0}, to_place_{0, 0, 0};  // on the floor below the roots
  std::map<std::size_t, double> missed_;                // of the target's joints, degrees
  std::vector<glm::dvec3> first_pose_;                  // of the source's joints
  std::vector<bool> moves_;
};

}  // namespace

Transferred transfer_motion(const MotionSource& source, const animator::Film& film, std::size_t actor,
                            std::uint32_t at) {
  return Transfer(source, film, actor, at).run();
}

}  // namespace mars::motion
