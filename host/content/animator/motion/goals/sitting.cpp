#include "host/content/animator/motion/goals/sitting.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/curve.h"
#include "host/content/animator/motion/gaits/gait.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/body/reach.h"
#include "host/content/animator/motion/body/surface.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kSittingSeconds = 1.6;
constexpr double kSittingLean = 44;   // degrees of the trunk, so that its weight stays over the feet
constexpr double kHandAlong = 0.6;    // of the thigh, where a wrist lies
constexpr double kHandOut = 0.6;      // of the way from above the hip to below the shoulder
constexpr double kSittingAskew = 10;  // degrees: see Foot
constexpr const char* kWiden = "widen the joint's limits in its model";
constexpr const char* kSitRemedy = "choose another seat-height, or widen the joint's limits in its model";

glm::dmat3 facing(const Stance& stance) { return canonical_turn(0, 0, stance.heading); }

// How far a joint's own segment reaches from it, drawn, along a canonical direction; of a skin what moves with it
// alone.
double extent(const Body& body, std::size_t number, const glm::dvec3& direction) {
  const modeler::Joint& joint = body.model->joints[number];
  if (!joint.segment || !joint.segment->bones.empty())
    return reach_of_skin(*body.model, number, body.axes * direction, [&](std::size_t each) { return each == number; });
  double most = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const modeler::Box& box = joint.segment->sbb;
    const glm::dvec3 point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
    most =
        std::max(most, glm::dot(glm::transpose(body.axes) * modeler::segment_frame({}, joint).turn * point, direction));
  }
  return most;
}

// Of the hips over the seat: what is between them, of the pelvis and of the thighs as they lie. Of a skin it is the
// thighs: what follows the pelvis hangs lower between the legs, and goes up with these.
double cushion(const Body& body, double hips_below_pelvis) {
  const auto& pelvis = body.model->joints[body.pelvis].segment;
  const double thighs = extent(body, body.legs[0].hip, {-1, 0, 0});
  if (thighs > 0 && !(pelvis && pelvis->bones.empty())) return thighs;
  return std::max(extent(body, body.pelvis, {0, 0, -1}) - hips_below_pelvis, thighs);
}

class Chair {
 public:
  Chair(const Scene& scene, const char* command, const char* remedy)
      : scene_(scene),
        command_(command),
        remedy_(remedy),
        body_(body_of(scene.model(), scene.actor.name, command)),
        start_(posture_of(scene)),
        from_(stance_of(body_, start_)),
        floor_(body_.floor_under(start_)),
        frames_(static_cast<int>(
            std::max(2.0, std::round(scene.frames(scene.arguments.number("seconds", kSittingSeconds, {0.1, 60})))))) {
    if (body_.stiff()) needed(body_, modeler::Limb::knee, modeler::Side::left, command);
    drop_ = from_.pelvis.z - hip_middle().z;
    for (Foot& foot : from_.feet) foot.askew = kSittingAskew;
    scene.last_after(frames_);
  }

  bool upright() const { return body_.is_upright(start_); }
  const Body& body() const { return body_; }
  const Stance& from() const { return from_; }
  double floor() const { return floor_; }
  double hip_drop() const { return drop_; }

  // From where it is to a place of the pelvis; `across` and `down` say how much of the way is done.
  Motion move(const glm::dvec3& pelvis, double leans_at, const std::function<double(double)>& across,
              const std::function<double(double)>& down, const Posture& arms) {
    std::vector<Posture> postures;
    Posture posture = start_;
    for (int frame = 0; frame <= frames_; ++frame) {
      const double u = double(frame) / frames_;
      Stance stance = from_;
      stance.pelvis = glm::mix(from_.pelvis, pelvis, glm::dvec3(across(u), across(u), down(u)));
      if (frame > 0) stance.pelvis.z = std::min(stance.pelvis.z, highest(stance));
      const double lean = kSittingLean * smooth(0, leans_at, u) * (1 - smooth(leans_at, 1, u));
      stance.tilt = from_.tilt * (1 - u) + glm::dvec3(0, 0.45 * lean, 0);
      bend(stance, lean);
      straighten_between(body_, stance);
      take_stance(body_, stance, posture, std::string(command_) + " at frame " + std::to_string(scene_.at + frame),
                  remedy_);
      move_arms(arms, u, posture);
      postures.push_back(posture);
    }
    begin_at(*body_.model, start_, frames_ / 2.0, postures);
    return {keys_of(body_, body_.joints(), postures, scene_.at), scene_.at + std::uint32_t(frames_), ""};
  }

  // Arms as they are in the end: `start_` with turns of joints.
  Posture with_arms(const std::map<std::size_t, glm::dmat3>& turns) const {
    Posture posture = start_;
    for (const auto& [joint, turn] : turns) posture.pose[joint] = numbers_for(body_, joint, turn, posture.pose[joint]);
    return posture;
  }

  // Hands on thighs, for a figure that sits at `pelvis`.
  Posture with_hands_on_thighs(const glm::dvec3& pelvis) const {
    Posture posture = with_arms(at_ease(body_));
    Stance stance = from_;
    stance.pelvis = pelvis;
    stance.tilt = {0, 0, 0};
    take_stance(body_, stance, posture, std::string(command_), remedy_);
    for (const modeler::Side side : kSides) {
      const std::size_t shoulder = body_.find(modeler::Limb::shoulder, side),
                        elbow = body_.find(modeler::Limb::elbow, side), wrist = body_.find(modeler::Limb::wrist, side);
      if (shoulder == modeler::kNone || elbow == modeler::kNone || wrist == modeler::kNone) continue;
      lay_hand(side, shoulder, elbow, wrist, posture);
    }
    return posture;
  }

 private:
  // The wrist over the thigh, a little to the outside, and the palm down.
  void lay_hand(modeler::Side side, std::size_t shoulder, std::size_t elbow, std::size_t wrist,
                Posture& posture) const {
    const double s = sign_of(side);
    const auto place = [&](std::size_t joint) { return frame_in(*body_.model, posture, joint).place; };
    const auto pose = [&](std::size_t joint, const glm::dmat3& turn) {
      posture.pose[joint] = numbers_for(body_, joint, turn, posture.pose[joint]);
    };
    pose(shoulder, hanging_shoulder(body_, side, {s * 10, -15, 0}));
    pose(elbow, hanging_elbow(body_, side, {0, -60, s * -75}));
    pose(wrist, glm::dmat3(1));
    const Leg& leg = body_.leg(side);
    const glm::dvec3 left = facing(from_)[1], hip = place(leg.hip);
    const double out = kHandOut * glm::dot(place(shoulder) - hip, left);
    const double thick = extent(body_, leg.hip, {1, 0, 0}) * 0.8 + extent(body_, wrist, {0, -s, 0});
    const double arm = glm::distance(place(shoulder), place(elbow)) + glm::distance(place(elbow), place(wrist));
    const std::size_t joints[] = {shoulder, elbow};
    const Goal goals[] = {
        {.joint = wrist, .place = glm::mix(hip, place(leg.knee), kHandAlong) + out * left + glm::dvec3(0, 0, thick)},
        {.joint = wrist, .turn_weight = 0.2 * arm, .direction = body_.axes[1], .across = left}};
    reach(*body_.model, posture, joints, goals);
  }

  glm::dvec3 hip_middle() const {
    return 0.5 * (frame_in(*body_.model, start_, body_.legs[0].hip).place +
                  frame_in(*body_.model, start_, body_.legs[1].hip).place);
  }

  // Of the pelvis, so that both legs reach their feet.
  double highest(const Stance& stance) const {
    double least = 1e300;
    for (const modeler::Side side : kSides) {
      const glm::dvec3 hip = stance.pelvis + facing(stance) * glm::dvec3(0, body_.leg(side).aside, -drop_);
      const glm::dvec3& ankle = stance.feet[index_of(side)].ankle;
      const double far = elementary::hypot(hip.x - ankle.x, hip.y - ankle.y), reach = 0.9995 * body_.leg(side).length();
      least = std::min(least, ankle.z + std::sqrt(std::max(0.0, reach * reach - far * far)) + drop_);
    }
    return least;
  }

  void bend(Stance& stance, double lean) const {
    const auto add = [&](modeler::Trunk part, double share) {
      if (const std::size_t joint = body_.find(part); joint != modeler::kNone)
        stance.turns[joint] = canonical_turn(0, share * lean, 0);
    };
    add(modeler::Trunk::spine, 0.3);
    add(modeler::Trunk::chest, 0.25);
    add(modeler::Trunk::neck, -0.3);
    add(modeler::Trunk::head, -0.3);
  }

  void move_arms(const Posture& arms, double u, Posture& posture) const {
    for (const modeler::Side side : kSides)
      for (const modeler::Limb limb : {modeler::Limb::shoulder, modeler::Limb::elbow, modeler::Limb::wrist})
        if (const std::size_t joint = body_.find(limb, side); joint != modeler::kNone)
          posture.pose[joint] = glm::mix(start_.pose[joint], arms.pose[joint], smooth(0.1, 0.95, u));
  }

  const Scene& scene_;
  const char* command_;
  const char* remedy_;  // where a foot cannot stand
  Body body_;
  Posture start_;
  Stance from_;
  double floor_;
  int frames_;
  double drop_;  // of the hips below the pelvis
};

glm::dvec3 between_feet(const Stance& stance) { return 0.5 * (stance.feet[0].ankle + stance.feet[1].ankle); }

[[noreturn]] void fail(const Scene& scene, const char* what, const char* command, const char* remedy) {
  throw Failure(what + (" at frame " + std::to_string(scene.at)), "actor '" + scene.actor.name + "', " + command,
                remedy);
}

// Where the hips come, by the seat's height or, without it, with level thighs.
struct Seated {
  double hips;  // height in the world
  double back;  // behind the ankles, with upright shins
  double soft;  // of the hips over the seat
};

Seated seated(const Scene& scene, const Chair& chair, const std::optional<double>& height) {
  const Leg& leg = chair.body().legs[0];
  const double soft = cushion(chair.body(), chair.hip_drop()), level = between_feet(chair.from()).z + leg.shin;
  const double hips = height ? chair.floor() + *height + soft : level;
  if (std::abs(hips - level) > leg.thigh)
    scene.arguments.refuse(scene.arguments.has("on") ? "on" : "seat-height",
                           "is " + document::shown(animator::rounded(*height)) + ", out of this figure's reach",
                           "its thighs are level at " +
                               document::shown(animator::rounded(level - soft - chair.floor())));
  return {hips, std::sqrt(leg.thigh * leg.thigh - (hips - level) * (hips - level)), soft};
}

Chair chair_of(const Scene& scene) {
  require_two_legs(scene.model(), scene.actor.name, "sit");
  Chair chair(scene, "sit", kSitRemedy);
  if (!chair.upright())
    fail(scene, "does not stand", "sit",
         "let it stand up first, by the action stand; to do it again otherwise, give --at with the frame "
         "where it began");
  return chair;
}

}  // namespace

double hips_behind(const Scene& scene, double seat_height) { return seated(scene, chair_of(scene), seat_height).back; }

Motion sit_down(const Scene& scene) {
  Chair chair = chair_of(scene);
  const Seated seat = seated(scene, chair, scene.arguments.number("seat-height", {0, document::kFarthest}));
  const glm::dvec3 ankle = between_feet(chair.from());
  const glm::dvec3 behind =
      facing(chair.from()) * glm::dvec3(-scene.arguments.number("back", seat.back, {0, document::kFarthest}), 0, 0);
  const glm::dvec3 pelvis(ankle.x + behind.x, ankle.y + behind.y, seat.hips + chair.hip_drop());
  Motion motion = chair.move(
      pelvis, 0.5, [](double u) { return smooth(0, 0.9, u); }, [](double u) { return smooth(0.05, 1, u); },
      chair.with_hands_on_thighs(pelvis));
  const auto rounded_text = [](double value) {
    return document::shown(std::round(value * 1e4) / 1e4 + 0.0);
  };  // never -0
  motion.report = "sits at " + rounded_text(pelvis.x) + " " + rounded_text(pelvis.y) + ", on a seat of height " +
                  rounded_text(seat.hips - seat.soft - chair.floor());
  return motion;
}

Motion stand(const Scene& scene) {
  require_two_legs(scene.model(), scene.actor.name, "stand");
  Chair chair(scene, "stand", kWiden);
  if (chair.upright()) fail(scene, "stands already", "stand", "let it sit down first, by the action sit");
  const glm::dvec3 middle = between_feet(chair.from());
  const Body& body = chair.body();
  const Posture drawn = drawn_posture(*body.model);
  const glm::dvec3 ahead = glm::transpose(body.axes) * (frame_in(*body.model, drawn, body.legs[0].ankle).place -
                                                        frame_in(*body.model, drawn, body.pelvis).place);
  const glm::dvec3 pelvis =
      glm::dvec3(middle.x, middle.y, chair.floor() + body.height) - facing(chair.from()) * glm::dvec3(ahead.x, 0, 0);
  return chair.move(
      pelvis, 0.4, [](double u) { return smooth(0.05, 0.95, u); }, [](double u) { return smooth(0.15, 1, u); },
      chair.with_arms(at_ease(body)));
}

}  // namespace mars::motion
