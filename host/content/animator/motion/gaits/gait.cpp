#include "host/content/animator/motion/gaits/gait.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/arms.h"
#include "host/content/animator/motion/body/curve.h"
#include "host/content/animator/motion/body/stiff_legs.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kStandReach = 0.9992;    // of a leg that stands: never quite straight
constexpr double kSwingReach = 0.988;     // of one that swings: its knee does not snap
constexpr double kBeginsTooHigh = 0.004;  // of the leg: more than a foot that stands may miss
constexpr double kStiffRise = 0.05;       // of legs without knees, as the pelvis rolls
constexpr double kStiffRoll = 0.2;        // sine of that, at most
constexpr double kStiffLift = 0.02;       // of such legs at least, if need be round the outside

glm::dvec2 ahead(double heading) {
  return {elementary::cos(glm::radians(heading)), elementary::sin(glm::radians(heading))};
}

class Walker {
 public:
  Walker(const Body& body, const Posture& start, const Gait& gait, bool rolls)
      : body_(body),
        gait_(gait),
        carriage_(gait.manner->carriage),
        rolls_(rolls),
        start_(stance_of(body, start)),
        floor_(body.floor_under(start)),
        hang_{hang_beside(body, modeler::Side::left), hang_beside(body, modeler::Side::right)} {
    for (const modeler::Side side : kSides) {
      const Foot& foot = start_.feet[index_of(side)];
      const Footing footing{body.leg(side), gait.manner->tread,   gait.period,
                            floor_,         gait.style.knee_lift, sign_of(side) * round_about(side)};
      feet_.emplace_back(footing, Footprint{{foot.ankle.x, foot.ankle.y}, foot.heading});
    }
    for (const Step& step : gait.steps) feet_[index_of(step.side)].add(step);
    for (const Waypoint& point : gait.way) headings_.push_back({point.time, point.heading});
  }

  Stance at(double time) const {
    Stance stance = body_at(time);
    for (const modeler::Side side : kSides) stance.feet[index_of(side)] = feet_[index_of(side)].at(time);
    return stance;
  }

  // How far the pelvis is too high for the feet that stand or swing there.
  double too_high(const Stance& stance) const {
    double most = 0;
    for (const modeler::Side side : kSides) {
      const Foot& foot = stance.feet[index_of(side)];
      const glm::dvec3 hip = hip_of(stance, side), way = hip - foot.ankle;
      const double reach = (foot.stands ? kStandReach : kSwingReach) * body_.leg(side).length();
      const double across = std::min(elementary::hypot(way.x, way.y), reach);
      most = std::max(most, way.z - std::sqrt(reach * reach - across * across));
    }
    return most;
  }

 private:
  glm::dvec3 hip_of(const Stance& stance, modeler::Side side) const {
    const Leg& leg = body_.leg(side);
    const glm::dmat3 turn = canonical_turn(0, 0, stance.heading) * canonical_turn(stance.tilt);
    const Posture drawn = drawn_posture(*body_.model);
    const glm::dvec3 from = glm::transpose(body_.axes) * (frame_in(*body_.model, drawn, leg.hip).place -
                                                          frame_in(*body_.model, drawn, body_.pelvis).place);
    return stance.pelvis + turn * from;
  }

  // By the left foot's cycle, from its landing to its next; two steps.
  double phase(double time) const {
    const Step& first = gait_.steps.front();
    return ((time - first.land) / gait_.period + (first.side == modeler::Side::left ? 0 : 1)) / 2;
  }

  // Of the swings of a walk: they grow with the first step and end with the last.
  double fullness(double time) const {
    return smooth(0, gait_.steps.front().land, time) *
           (1 - smooth(gait_.end() - 1.6 * gait_.period, gait_.end(), time));
  }

  Stance body_at(double time) const {
    Stance stance;
    const double full = fullness(time), leg = body_.leg_length(), p = phase(time);
    const double swing = full * std::min(gait_.stride / gait_.manner->tread.stride, 1.2);
    const auto wave = [&](double at, double times = 1) {
      return elementary::cos(2 * std::numbers::pi * times * (p - at));
    };
    const double loose = body_.planar() || body_.stiff() ? 0 : 1;  // a figure that cannot sway does not
    move_along(time, stance);
    const double settle = smooth(0, gait_.steps.front().land, time);
    const double height = start_.pelvis.z - floor_ + (body_.height - start_.pelvis.z + floor_) * settle;
    const glm::dvec2 forward = ahead(stance.heading), left(-forward.y, forward.x);
    const glm::dvec2 sway = carriage_.surge * leg * swing * (body_.stiff() ? 0 : wave(0.015, 2)) * forward +
                            loose * carriage_.sway * leg * full * wave(0.31) * left;
    stance.pelvis.x += sway.x;
    stance.pelvis.y += sway.y;
    stance.pelvis.z = floor_ + height -
                      leg * swing * (carriage_.sink + carriage_.bounce * gait_.style.bounce * wave(carriage_.low, 2));
    const double lean = full * gait_.style.lean;
    stance.tilt = (1 - settle) * start_.tilt + glm::dvec3(loose * carriage_.roll * swing * wave(0.18) + waddle(time),
                                                          swing * (carriage_.lean + wave(0.05, 2)) + 0.4 * lean,
                                                          -carriage_.twist * loose * swing * wave(0));
    add_trunk(stance, p, swing, lean);
    straighten_between(body_, stance);
    for (const modeler::Side side : kSides) add_arm(stance, side, p, swing);
    return stance;
  }

  // Legs without knees are lifted by the hips: degrees of roll that raise the side that swings.
  double waddle(double time) const {
    if (!body_.stiff() || !rolls_ || body_.planar()) return 0;
    const auto down = [](double at, const Step& step) { return at < step.land; };
    const auto step = std::upper_bound(gait_.steps.begin(), gait_.steps.end(), time, down);
    if (step == gait_.steps.end() || time <= step->off) return 0;
    const double u = (time - step->off) / (step->land - step->off);
    return sign_of(step->side) * glm::degrees(elementary::asin(roll(step->side))) *
           elementary::sin(std::numbers::pi * u);
  }

  double roll(modeler::Side side) const {  // its sine
    return std::min(kStiffRise * body_.leg_length() / (2 * std::abs(body_.leg(side).aside)), kStiffRoll);
  }

  // How far aside a leg of one piece is carried, that it may rise as far as the roll does not lift it.
  double round_about(modeler::Side side) const {
    if (!body_.stiff() || body_.planar()) return 0;
    const double leg = body_.leg_length(), lifted = rolls_ ? 2 * std::abs(body_.leg(side).aside) * roll(side) : 0;
    return leg * std::sqrt(2 * std::max(0.0, kStiffLift - lifted / leg));
  }

  void move_along(double time, Stance& stance) const {
    const auto passed = [](const Waypoint& point, double at) { return point.time < at; };
    const auto next = std::lower_bound(gait_.way.begin() + 1, gait_.way.end() - 1, time, passed);
    const Waypoint &a = next[-1], &b = *next;
    for (int axis = 0; axis < 2; ++axis)
      stance.pelvis[axis] =
          hermite({a.time, a.place[axis]}, {b.time, b.place[axis]}, a.velocity[axis], b.velocity[axis], time);
    stance.heading = curve_through(headings_, 0, 0, time);
  }

  void add_trunk(Stance& stance, double p, double swing, double lean) const {
    const auto wave = [&](double at, double times = 1) {
      return elementary::cos(2 * std::numbers::pi * times * (p - at));
    };
    const auto add = [&](modeler::Trunk part, const glm::dvec3& swung, double share) {
      if (const std::size_t joint = body_.find(part); joint != modeler::kNone)
        stance.turns[joint] = canonical_turn(swing * swung + glm::dvec3(0, share * lean, 0));
    };
    const Carriage& c = carriage_;
    add(modeler::Trunk::spine, {-2.2 * wave(0.18), c.bend_of_spine, c.twist_of_spine * wave(0.02)}, 0.3);
    add(modeler::Trunk::chest, {-1.4 * wave(0.18), c.bend_of_chest - 0.8 * wave(0.1, 2), c.twist_of_chest * wave(0.04)},
        0.3);
    add(modeler::Trunk::neck, {0.6 * wave(0.18), c.bend_of_neck, -2.6 * wave(0.05)}, -0.4);
    add(modeler::Trunk::head, {0.5 * wave(0.18), c.bend_of_head, -2.4 * wave(0.05)}, -0.5);
  }

  void add_arm(Stance& stance, modeler::Side side, double p, double swing) const {
    const double own = side == modeler::Side::left ? p : p + 0.5, s = sign_of(side),
                 much = swing * gait_.style.arm_swing;
    const auto wave = [&](double late) { return elementary::cos(2 * std::numbers::pi * (own - late)); };
    if (const std::size_t joint = body_.find(modeler::Limb::shoulder, side); joint != modeler::kNone)
      stance.turns[joint] =
          hanging_shoulder(body_, side,
                           {s * (hang_[index_of(side)] + 1.5 * much * wave(0.5)),
                            carriage_.shoulder.mean * swing + carriage_.shoulder.by * much * wave(0.02), s * -12});
    if (const std::size_t joint = body_.find(modeler::Limb::elbow, side); joint != modeler::kNone)
      stance.turns[joint] = hanging_elbow(
          body_, side, {0, -14 + carriage_.elbow.mean * swing + carriage_.elbow.by * much * wave(0.09), s * -14});
    if (const std::size_t joint = body_.find(modeler::Limb::wrist, side); joint != modeler::kNone)
      stance.turns[joint] = hanging_wrist(body_, side, {s * (-6 + 5 * much * wave(0.2)), 4 + 5 * much * wave(0.16), 0});
  }

  const Body& body_;
  const Gait& gait_;
  const Carriage& carriage_;
  bool rolls_;  // the pelvis, to lift legs of one piece
  Stance start_;
  double floor_;
  std::array<double, 2> hang_;  // of left and right arm, degrees
  std::vector<Footwork> feet_;  // of left and right
  std::vector<CurvePoint> headings_;
};

// It begins as high as it is, unless a foot does not reach the floor then, as where legs are drawn unequal.
void lower_smoothly(std::vector<double>& high, const Gait& gait, double leg) {
  const std::vector<double> cover = smooth_cover(high, std::max(1, int(gait.period / 3)));
  if (high[0] < kBeginsTooHigh * leg) high[0] = 0;
  for (std::size_t frame = 1; frame < high.size(); ++frame)
    high[frame] = std::max(high[frame], cover[frame] * smooth(0, gait.steps.front().land, double(frame)));
}

}  // namespace

std::map<std::size_t, glm::dmat3> at_ease(const Body& body) {
  std::map<std::size_t, glm::dmat3> turns;
  for (const modeler::Trunk part :
       {modeler::Trunk::spine, modeler::Trunk::chest, modeler::Trunk::neck, modeler::Trunk::head})
    if (const std::size_t joint = body.find(part); joint != modeler::kNone) turns[joint] = glm::dmat3(1);
  for (const std::size_t joint : body.between()) turns[joint] = glm::dmat3(1);
  for (const modeler::Side side : kSides) {
    const double s = sign_of(side);
    const auto add = [&](modeler::Limb limb, const glm::dmat3& turn) {
      if (const std::size_t joint = body.find(limb, side); joint != modeler::kNone) turns[joint] = turn;
    };
    add(modeler::Limb::shoulder, hanging_shoulder(body, side, {s * hang_beside(body, side), 0, s * -12}));
    add(modeler::Limb::elbow, hanging_elbow(body, side, {0, -14, s * -14}));
    add(modeler::Limb::wrist, hanging_wrist(body, side, {s * -6, 4, 0}));
  }
  return turns;
}

namespace {

std::vector<Stance> stances_of(const Body& body, const Posture& start, const Gait& gait, bool rolls) {
  const Walker walker(body, start, gait, rolls);
  std::vector<Stance> stances;
  std::vector<double> high;
  for (int frame = 0; frame <= int(gait.end()); ++frame) stances.push_back(walker.at(frame));
  if (body.stiff()) {
    stand_stiffly(body, start, stances);
    return stances;
  }
  for (const Stance& stance : stances) high.push_back(walker.too_high(stance));
  lower_smoothly(high, gait, body.leg_length());
  for (std::size_t frame = 0; frame < stances.size(); ++frame) stances[frame].pelvis.z -= high[frame];
  return stances;
}

std::vector<Posture> postures_of(const Body& body, const Posture& start, const std::vector<Stance>& stances,
                                 std::uint32_t first_frame, const std::string& doing, const std::string& remedy) {
  std::vector<Posture> postures;
  Posture posture = start;
  for (std::size_t frame = 0; frame < stances.size(); ++frame) {
    take_stance(body, stances[frame], posture, doing + " at frame " + std::to_string(first_frame + frame), remedy);
    postures.push_back(posture);
  }
  return postures;
}

}  // namespace

std::vector<Posture> postures_of(const Body& body, const Posture& start, const Gait& gait, std::uint32_t first_frame,
                                 const std::string& doing, const std::string& remedy) {
  const auto moved = [&](bool rolls) {
    return postures_of(body, start, stances_of(body, start, gait, rolls), first_frame, doing, remedy);
  };
  if (!body.stiff()) return moved(false);
  try {
    return moved(true);
  } catch (const Failure&) {
    return moved(false);  // joints that do not allow the roll
  }
}

}  // namespace mars::motion
