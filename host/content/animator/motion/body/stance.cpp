#include "host/content/animator/motion/body/stance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/reach.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kNearEnough = 0.003;  // of the leg's length: how far a standing foot may be from where it should
constexpr double kFlatEnough = 3;      // degrees
constexpr double kTurnWeight = 0.3;    // of the leg's length, for a radian of the foot's turn
constexpr double kKneeWeight = 0.1;    // and of the knee's
constexpr double kKneeShare = 0.7;     // of the foot's heading against the pelvis, to which the knee points
constexpr double kAtLimit = 1e-3;      // degrees
constexpr double kZigzag = 5;          // degrees that a knee is drawn bent
constexpr double kBentElbow = 0.2;     // sine of the angle from which an elbow is drawn bent
constexpr double kMostArmTwist = 120;  // degrees that an upper arm turns about itself to have such a forearm in front

glm::dmat3 heading_turn(double degrees) { return modeler::rotation_by_degrees({0, 0, 1}, degrees); }

// The smallest turn that takes a direction to straight down.
glm::dmat3 turned_down(const glm::dvec3& along) {
  const glm::dvec3 down(0, 0, -1), axis = glm::cross(along, down);
  const double sine = glm::length(axis);
  return sine < 0.1 ? glm::dmat3(1) : modeler::rotation(axis / sine, elementary::atan2(sine, glm::dot(along, down)));
}

// How an arm comes to hang from how it is drawn.
struct Hanging {
  glm::dmat3 turn{1};  // of the upper arm: straight down, with the forearm, if it is drawn bent, to the front
  double bent = 0;     // degrees of such a forearm
};

Hanging hanging_of(const Body& body, modeler::Side side) {
  const Posture drawn = drawn_posture(*body.model);
  const std::size_t shoulder = body.find(modeler::Limb::shoulder, side), elbow = body.find(modeler::Limb::elbow, side);
  const std::size_t wrist = body.find(modeler::Limb::wrist, side);
  if (elbow == modeler::kNone) return {};
  const auto bone = [&](std::size_t from, std::size_t to) {
    return glm::normalize(glm::transpose(body.axes) *
                          (frame_in(*body.model, drawn, to).place - frame_in(*body.model, drawn, from).place));
  };
  Hanging hanging{turned_down(bone(shoulder, elbow))};
  if (wrist == modeler::kNone) return hanging;
  const glm::dvec3 forearm = hanging.turn * bone(elbow, wrist);
  const double out = elementary::hypot(forearm.x, forearm.y),
               aside = glm::degrees(elementary::atan2(forearm.y, forearm.x));
  if (out < kBentElbow || std::abs(aside) > kMostArmTwist) return hanging;
  hanging.bent = glm::degrees(elementary::atan2(out, -forearm.z));
  hanging.turn = heading_turn(-aside) * hanging.turn;
  return hanging;
}

void turn_actor(const Body& body, double heading, Posture& posture) {
  const double more = std::remainder(heading - body.heading_of(posture), 360.0);
  if (posture.turn.x == 0 && posture.turn.y == 0)
    posture.turn.z += more;
  else
    posture.turn = canonical_degrees(heading_turn(more) * actor_turn(posture));
}

// About which of the knee's axes it bends, and the direction of its axis in its own frame, to the left.
struct Hinge {
  int axis;
  double sign;  // of the number that bends the shin back
  glm::dvec3 direction;
};

Hinge hinge_of(const Body& body, const Leg& leg) {
  const modeler::Joint& knee = body.model->joints[leg.knee];
  const glm::dvec3 axes[] = {knee.x_axis, knee.y_axis, glm::normalize(glm::cross(knee.x_axis, knee.y_axis))};
  Hinge best{1, 1, body.axes[1]};
  double most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = glm::dot(axes[axis], body.axes[1]);
    if (!knee.limits[axis].free() || std::abs(along) <= most) continue;
    most = std::abs(along);
    best = {axis, along < 0 ? -1.0 : 1.0, along < 0 ? -axes[axis] : axes[axis]};
  }
  return best;
}

// A leg that is straight does not know which way to bend: the knee begins where the hip's distance puts it.
void bend_knee(const Body& body, const Leg& leg, const Hinge& hinge, double distance, Posture& posture) {
  const double cosine =
      (leg.thigh * leg.thigh + leg.shin * leg.shin - distance * distance) / (2 * leg.thigh * leg.shin);
  const double bend = 180 - glm::degrees(elementary::acos(std::clamp(cosine, -1.0, 1.0)));
  const modeler::Limits& limits = body.model->joints[leg.knee].limits[hinge.axis];
  if (std::abs(leg.bent) > kZigzag) {  // such a leg bends on as it is drawn
    posture.pose[leg.knee][hinge.axis] =
        std::clamp(hinge.sign * (std::copysign(bend, leg.bent) - leg.bent), limits.lower, limits.upper);
    return;
  }
  const double forward = hinge.sign * bend, now = std::clamp(forward, limits.lower, limits.upper);
  const double backward = std::clamp(-forward, limits.lower, limits.upper);
  // A knee that bends only the other way, as a bird's heel does, bends so.
  posture.pose[leg.knee][hinge.axis] = std::abs(now) >= std::abs(backward) ? now : backward;
}

std::string degrees_of(double value) { return document::shown(std::round(value * 100) / 100 + 0.0) + " degrees"; }

// About which of the joint's axes it twists what hangs straight down from it.
int twist_axis(const Body& body, const modeler::Joint& joint) {
  const glm::dvec3 axes[] = {joint.x_axis, joint.y_axis, glm::cross(joint.x_axis, joint.y_axis)};
  int best = 2;
  for (int axis = 0; axis < 2; ++axis)
    if (std::abs(glm::dot(axes[axis], body.axes[2])) > std::abs(glm::dot(axes[best], body.axes[2]))) best = axis;
  return best;
}

// How far a joint twists to either side, degrees.
double twist_limit(const Body& body, const modeler::Joint& joint) {
  const modeler::Limits& limits = joint.limits[twist_axis(body, joint)];
  return std::max(0.0, std::min(-limits.lower, limits.upper));
}

std::string limit_in_the_way(const Body& body, const Posture& posture, std::span<const std::size_t> joints) {
  std::string all;
  for (const std::size_t number : joints) {
    const modeler::Joint& joint = body.model->joints[number];
    for (int axis = 0; axis < 3; ++axis) {
      const double value = posture.pose[number][axis];
      const modeler::Limits& limits = joint.limits[axis];
      if (value > limits.lower + kAtLimit && value < limits.upper - kAtLimit) continue;
      if (!limits.free() && axis == 2 && joint.freedoms() > 0) continue;  // few joints twist: never the cause
      const std::string what = limits.free() ? "is at its limit of " + degrees_of(value) + " about " + "xyz"[axis]
                                             : std::string("cannot turn about ") + "xyz"[axis];
      all += (all.empty() ? "'" : ", '") + joint.name + "' " + what;
    }
  }
  return all;
}

class LegReach {
 public:
  // `whose` foot: "left", "right fore".
  LegReach(const Body& body, const Leg& leg, const std::string& whose, const Foot& foot, const Stance& stance,
           Posture& posture)
      : body_(body), leg_(leg), whose_(whose), foot_(foot), stance_(stance), posture_(posture) {}

  // A leg of one piece that swings goes in the foot's direction as far as it goes.
  void solve() {
    const glm::dvec3 hip = frame_in(*body_.model, posture_, leg_.hip).place;
    glm::dvec3 to = foot_.ankle;
    if (leg_.knee == modeler::kNone && !foot_.stands) to = hip + leg_.length() * glm::normalize(to - hip);
    const glm::dmat3 turn =
        heading_turn(foot_.heading) * canonical_turn(0, foot_.pitch, 0) * glm::transpose(body_.axes);
    std::vector<Goal> goals{
        {.joint = leg_.ankle, .place = to, .turn = turn, .turn_weight = kTurnWeight * leg_.length()}};
    std::vector<std::size_t> leg{leg_.hip};
    if (leg_.knee != modeler::kNone) add_knee(hip, to, leg, goals);
    std::vector<std::size_t> all = leg;
    all.push_back(leg_.ankle);
    reach(*body_.model, posture_, all, goals);
    // Where not everything can be had, the foot's place comes first.
    goals[0].turn.reset();
    if (error_of(to) > kNearEnough * leg_.length() / 10) reach(*body_.model, posture_, leg, std::span(goals).first(1));
    const std::size_t ankle[] = {leg_.ankle};
    const Goal flat[] = {{.joint = leg_.ankle, .turn = turn}};
    reach(*body_.model, posture_, ankle, flat);
    if (leg_.toes != modeler::kNone)
      posture_.pose[leg_.toes] =
          numbers_for(body_, leg_.toes, canonical_turn(0, foot_.bent, 0), posture_.pose[leg_.toes]);
  }

  void require_footing(const std::string& doing, const std::string& remedy) const {
    if (!foot_.stands) return;
    const double far = error_of(foot_.ankle);
    std::vector<std::size_t> joints{leg_.hip};
    if (leg_.knee != modeler::kNone) joints.push_back(leg_.knee);
    if (far > kNearEnough * leg_.length()) {
      const std::string limit = limit_in_the_way(body_, posture_, joints);
      fail("its " + whose_ + " foot cannot be where it stands", limit.empty() ? "the leg is too short" : limit, doing,
           remedy);
    }
    const glm::dmat3 wanted = heading_turn(foot_.heading) * canonical_turn(0, foot_.pitch, 0);
    const glm::dmat3 is = body_.turn_of(posture_, leg_.ankle);
    const bool twists = twist_limit(body_, body_.model->joints[leg_.ankle]) > 0;
    const double tilted = glm::degrees(elementary::acos(std::min(1.0, glm::dot(is[2], wanted[2]))));
    const double off = glm::degrees(animator::turn_between(is, wanted).angle);
    if (tilted > kFlatEnough || off > std::max(kFlatEnough, twists ? 0 : foot_.askew)) {
      joints.assign(1, leg_.ankle);
      joints.push_back(leg_.hip);
      const std::string limit = limit_in_the_way(body_, posture_, joints);
      fail("its " + whose_ + " foot cannot stand on its sole", limit.empty() ? turn_missing(wanted) : limit, doing,
           remedy);
    }
  }

 private:
  void add_knee(const glm::dvec3& hip, const glm::dvec3& to, std::vector<std::size_t>& leg, std::vector<Goal>& goals) {
    const Hinge hinge = hinge_of(body_, leg_);
    bend_knee(body_, leg_, hinge, glm::distance(hip, to), posture_);
    leg.push_back(leg_.knee);
    // What the foot points beside the knee, the ankle twists.
    const double aside = std::remainder(foot_.heading - stance_.heading - stance_.tilt.z, 360.0);
    const double limit_of_twist = twist_limit(body_, body_.model->joints[leg_.ankle]);
    const double knees = foot_.heading - std::clamp((1 - kKneeShare) * aside, -limit_of_twist, limit_of_twist);
    goals.push_back({.joint = leg_.knee,
                     .turn_weight = kKneeWeight * leg_.length(),
                     .direction = hinge.direction,
                     .across = heading_turn(knees)[0]});
  }

  // The ankle's turn that would be needed, about that of its axes where most is missing.
  std::string turn_missing(const glm::dmat3& wanted) const {
    const modeler::Joint& ankle = body_.model->joints[leg_.ankle];
    const glm::dmat3 frame = frame_in(*body_.model, posture_, leg_.ankle).turn;
    const animator::Turn turn = animator::turn_between(frame, wanted * glm::transpose(body_.axes));
    const glm::dvec3 axes[] = {ankle.x_axis, ankle.y_axis, glm::normalize(glm::cross(ankle.x_axis, ankle.y_axis))};
    int most = 0;
    std::array<double, 3> along;
    for (int axis = 0; axis < 3; ++axis) {
      along[axis] = glm::degrees(turn.angle) * glm::dot(turn.axis, frame * axes[axis]);
      if (std::abs(along[axis]) > std::abs(along[most])) most = axis;
    }
    return "'" + ankle.name + "' would have to turn " + degrees_of(along[most]) + " more about " + "xyz"[most];
  }

  double error_of(const glm::dvec3& to) const {
    return glm::distance(frame_in(*body_.model, posture_, leg_.ankle).place, to);
  }

  [[noreturn]] void fail(const std::string& what, const std::string& why, const std::string& doing,
                         const std::string& remedy) const {
    throw Failure(what + ": " + why, "actor '" + body_.name + "', " + doing, remedy);
  }

  const Body& body_;
  const Leg& leg_;
  std::string whose_;
  const Foot& foot_;
  const Stance& stance_;
  Posture& posture_;
};

Foot foot_of(const Body& body, const Posture& posture, const Leg& leg) {
  const glm::dmat3 turn = body.turn_of(posture, leg.ankle);
  Foot foot;
  foot.ankle = frame_in(*body.model, posture, leg.ankle).place;
  foot.heading = glm::degrees(elementary::atan2(turn[0].y, turn[0].x));
  foot.pitch = -glm::degrees(elementary::asin(std::clamp(turn[0].z, -1.0, 1.0)));
  return foot;
}

}  // namespace

Stance stance_of(const Body& body, const Posture& posture) {
  Stance stance;
  stance.heading = body.heading_of(posture);
  stance.pelvis = frame_in(*body.model, posture, body.pelvis).place;
  const glm::dmat3 facing = heading_turn(-stance.heading);
  stance.tilt = canonical_degrees(facing * body.turn_of(posture, body.pelvis));
  for (const modeler::Side side : kSides) {
    stance.feet[index_of(side)] = foot_of(body, posture, body.leg(side));
    if (body.forelegs) stance.forefeet[index_of(side)] = foot_of(body, posture, (*body.forelegs)[index_of(side)]);
  }
  return stance;
}

glm::dmat3 hanging_shoulder(const Body& body, modeler::Side side, const glm::dvec3& degrees) {
  return canonical_turn(degrees) * hanging_of(body, side).turn;
}

glm::dmat3 hanging_elbow(const Body& body, modeler::Side side, const glm::dvec3& degrees) {
  const Hanging hanging = hanging_of(body, side);
  glm::dmat3 turn = canonical_turn(degrees);
  if (hanging.bent != 0) turn *= canonical_turn(0, hanging.bent, 0);
  return glm::transpose(hanging.turn) * turn * hanging.turn;
}

glm::dmat3 hanging_wrist(const Body& body, modeler::Side side, const glm::dvec3& degrees) {
  const glm::dmat3 hang = hanging_of(body, side).turn;
  return glm::transpose(hang) * canonical_turn(degrees) * hang;
}

glm::dvec3 numbers_for(const Body& body, std::size_t joint, const glm::dmat3& turn, const glm::dvec3& near) {
  return nearest_turns(body.model->joints[joint], body.axes * turn * glm::transpose(body.axes), near);
}

void straighten_between(const Body& body, Stance& stance) {
  for (const std::size_t joint : body.between()) stance.turns[joint] = glm::dmat3(1);
}

void place_pelvis(const Body& body, const Stance& stance, Posture& posture) {
  turn_actor(body, stance.heading, posture);
  const std::size_t joints[] = {body.pelvis};
  const Goal goals[] = {
      {.joint = body.pelvis,
       .turn = heading_turn(stance.heading) * canonical_turn(stance.tilt) * glm::transpose(body.axes)}};
  reach(*body.model, posture, joints, goals);
  posture.place += stance.pelvis - frame_in(*body.model, posture, body.pelvis).place;
}

void take_stance(const Body& body, const Stance& stance, Posture& posture, const std::string& doing,
                 const std::string& remedy) {
  place_pelvis(body, stance, posture);
  for (const auto& [joint, turn] : stance.turns)
    posture.pose[joint] = numbers_for(body, joint, turn, posture.pose[joint]);
  const auto stand = [&](const Leg& leg, const std::string& whose, const Foot& foot) {
    LegReach reach(body, leg, whose, foot, stance, posture);
    reach.solve();
    reach.require_footing(doing, remedy);
  };
  for (const modeler::Side side : kSides) {
    const std::string name = side == modeler::Side::left ? "left" : "right";
    stand(body.leg(side), body.forelegs ? name + " hind" : name, stance.feet[index_of(side)]);
    if (body.forelegs) stand((*body.forelegs)[index_of(side)], name + " fore", stance.forefeet[index_of(side)]);
  }
}

}  // namespace mars::motion
