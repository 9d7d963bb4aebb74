#include "host/content/animator/motion/gaits/four_legs.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "host/content/animator/motion/gaits/advance.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kFourLegReach = 0.993;                        // of a leg that stands: never quite straight
constexpr double kFourLegLead = 0.05;                          // of a stride, before the first heel rises
constexpr double kSetOut = 0.1;                                // after which the trunk sets out
constexpr double kFourLegSettle = 0.3;                         // and after the last has landed
constexpr double kStridesToSpeed = 1.5, kStridesToStop = 1.5;  // strides
constexpr int kLoweringRounds = 3;  // of lowering hips and shoulders, each of which moves the other a little
constexpr const char* kFourLegRemedy = "take shorter strides or steps, or widen the joint's limits in its model";

const std::array<Leg, 2>& legs_of(const Body& body, bool fore) { return fore ? *body.forelegs : body.legs; }

// Strides until the first foot leaves.
double lead_of(const FourLegGait& gait) { return kFourLegLead + gait.hind_tread.rise * gait.duty; }

double first_landing(const FourLegGait& gait, double period) {
  return std::round((lead_of(gait) + 1 - gait.duty) * period);
}

double latest(const FourLegGait& gait) { return std::max({gait.hind[0], gait.hind[1], gait.fore[0], gait.fore[1]}); }

class Strider {
 public:
  Strider(const Body& body, const Posture& start, const FourLegGait& gait, const FourLegStyle& style,
          const Errand& errand, double period)
      : body_(body),
        start_(start),
        gait_(gait),
        style_(style),
        errand_(errand),
        period_(period),
        from_(stance_of(body, start)),
        floor_(body.floor_under(start)),
        lands_(first_landing(gait, period)),
        stops_(lands_ + (errand.strides + latest(gait)) * period),
        advance_(errand.path.length, kSetOut * period, stops_, kStridesToSpeed * period, kStridesToStop * period) {
    measure();
    for (const bool fore : {false, true})
      for (const modeler::Side side : kSides) plan(fore, side);
  }

  // All of a film's frames from the start.
  std::vector<Stance> stances() const {
    std::vector<Stance> all;
    for (int frame = 0; frame <= int(four_leg_frames(gait_, errand_.strides, period_)); ++frame)
      all.push_back(at(frame));
    for (int round = 0; round < kLoweringRounds; ++round) lower(all);
    return all;
  }

 private:
  // ---- Where the trunk is

  void measure() {
    const Posture drawn = drawn_posture(*body_.model);
    const auto middle = [&](const std::array<Leg, 2>& legs) {
      return 0.5 *
             (frame_in(*body_.model, drawn, legs[0].hip).place + frame_in(*body_.model, drawn, legs[1].hip).place);
    };
    const glm::dmat3 back = glm::transpose(body_.axes);
    const glm::dvec3 pelvis = frame_in(*body_.model, drawn, body_.pelvis).place;
    const glm::dvec3 hips = back * (middle(body_.legs) - pelvis), shoulders = back * (middle(*body_.forelegs) - pelvis);
    long_ = shoulders.x - hips.x;
    pelvis_ = -0.5 * (hips.x + shoulders.x);
    height_ = body_.height + hips.z;
    for (const bool fore : {false, true})
      for (const modeler::Side side : kSides) {
        const glm::dvec3 ankle =
            back * (frame_in(*body_.model, drawn, legs_of(body_, fore)[index_of(side)].ankle).place - pelvis);
        rest_[fore][index_of(side)] = {ankle.x + pelvis_, ankle.y};
      }
    began_ = {glm::dvec2(from_.pelvis) - pelvis_ * ahead_of(from_.heading), from_.heading};
  }

  Stand trunk_at(double time) const {
    if (errand_.turn != 0) {
      const double way = smooth(0.2 * period_, stops_, time);
      return {began_.middle, began_.heading + errand_.turn * way};
    }
    const double s = advance_.at(time);
    return {errand_.path.at(s), errand_.path.heading(s)};
  }

  // ---- Feet

  Footprint print(const Stand& trunk, bool fore, modeler::Side side) const {
    const glm::dvec2 ahead = ahead_of(trunk.heading), left(-ahead.y, ahead.x), rest = rest_[fore][index_of(side)];
    return {trunk.middle + rest.x * ahead + rest.y * left, trunk.heading};
  }

  void plan(bool fore, modeler::Side side) {
    const double phase = (fore ? gait_.fore : gait_.hind)[index_of(side)];
    const double stands = std::round(gait_.duty * period_), swings = period_ - stands;
    const Foot& foot = (fore ? from_.forefeet : from_.feet)[index_of(side)];
    const Footing footing{legs_of(body_, fore)[index_of(side)],
                          fore ? gait_.fore_tread : gait_.hind_tread,
                          stands,
                          floor_,
                          style_.lift,
                          0};
    Footwork work(footing, {{foot.ankle.x, foot.ankle.y}, foot.heading});
    for (int stride = 0; stride <= errand_.strides; ++stride) {
      const double land = std::round(lands_ + (stride + phase) * period_);
      const Stand trunk = trunk_at(stride == errand_.strides ? stops_ : land + stands / 2);
      work.add({side, print(trunk, fore, side), land - swings, land});
    }
    feet_[fore].push_back(std::move(work));
  }

  // ---- The rest of the body

  double fullness(double time) const {
    return smooth(0, lands_, time) * (1 - smooth(stops_ - period_, stops_ + 0.2 * period_, time));
  }

  double beat(const Beat& beat, double time) const {
    const double phase = (time - lands_) / period_ - beat.highest;
    return fullness(time) * beat.by * elementary::cos(2 * std::numbers::pi * beat.times * phase);
  }

  Stance at(double time) const {
    Stance stance;
    const Stand trunk = trunk_at(time);
    const double settle = smooth(0, lands_, time);
    stance.heading = trunk.heading;
    const glm::dvec2 place = trunk.middle + pelvis_ * ahead_of(trunk.heading);
    stance.pelvis.x = place.x;
    stance.pelvis.y = place.y;
    stance.pelvis.z = glm::mix(from_.pelvis.z, floor_ + body_.height, settle) +
                      height_ * (style_.bounce * beat(gait_.bounce, time) - fullness(time) * gait_.sink);
    const double flex = beat(gait_.flex, time);
    stance.tilt = (1 - settle) * from_.tilt + glm::dvec3(0, style_.bounce * beat(gait_.rock, time) - 0.5 * flex, 0);
    add_trunk(stance, flex, beat(gait_.nod, time));
    straighten_between(body_, stance);
    for (const modeler::Side side : kSides) {
      stance.feet[index_of(side)] = feet_[0][index_of(side)].at(time);
      stance.forefeet[index_of(side)] = feet_[1][index_of(side)].at(time);
    }
    return stance;
  }

  void add_trunk(Stance& stance, double flex, double nod) const {
    const auto add = [&](modeler::Trunk part, double degrees) {
      if (const std::size_t joint = body_.find(part); joint != modeler::kNone)
        stance.turns[joint] = canonical_turn(0, degrees, 0);
    };
    const bool both =
        body_.find(modeler::Trunk::spine) != modeler::kNone && body_.find(modeler::Trunk::chest) != modeler::kNone;
    add(modeler::Trunk::spine, both ? flex / 2 : flex);
    add(modeler::Trunk::chest, both ? flex / 2 : flex);
    add(modeler::Trunk::neck, nod - 0.5 * flex);
    add(modeler::Trunk::head, -0.6 * nod);
  }

  // ---- As high as legs reach

  // How far hips or shoulders are too high for the feet that stand.
  double too_high(const Stance& stance, const Posture& posture, bool fore) const {
    double most = 0;
    for (const modeler::Side side : kSides) {
      const Foot& foot = (fore ? stance.forefeet : stance.feet)[index_of(side)];
      if (!foot.stands) continue;
      const Leg& leg = legs_of(body_, fore)[index_of(side)];
      const glm::dvec3 way = frame_in(*body_.model, posture, leg.hip).place - foot.ankle;
      const double reach = kFourLegReach * leg.length(), across = std::min(elementary::hypot(way.x, way.y), reach);
      most = std::max(most, way.z - std::sqrt(reach * reach - across * across));
    }
    return most;
  }

  void lower(std::vector<Stance>& stances) const {
    std::array<std::vector<double>, 2> high;
    Posture posture = start_;
    for (const Stance& stance : stances) {
      place_pelvis(body_, stance, posture);
      for (const auto& [joint, turn] : stance.turns)
        posture.pose[joint] = numbers_for(body_, joint, turn, posture.pose[joint]);
      for (const bool fore : {false, true}) high[fore].push_back(too_high(stance, posture, fore));
    }
    for (std::vector<double>& each : high) each = smooth_cover(each, std::max(1, int(period_ / 8)));
    for (std::size_t frame = 1; frame < stances.size(); ++frame) {
      stances[frame].pelvis.z -= high[0][frame];
      stances[frame].tilt.y += glm::degrees(elementary::atan2(high[1][frame] - high[0][frame], long_));
    }
  }

  const Body& body_;
  const Posture& start_;
  const FourLegGait& gait_;
  const FourLegStyle& style_;
  const Errand& errand_;
  double period_;
  Stance from_;
  double floor_;
  double lands_, stops_;  // frames: phase 0 of the first stride; the trunk stands
  Advance advance_;
  double long_;                                    // from hips to shoulders
  double pelvis_;                                  // before the middle of the four feet
  double height_;                                  // of the hips
  std::array<std::array<glm::dvec2, 2>, 2> rest_;  // ankles before and beside the middle: hind and fore
  Stand began_;
  std::array<std::vector<Footwork>, 2> feet_;
};

}  // namespace

double lost_strides(const FourLegGait& gait) {
  const double lasts = lead_of(gait) + 1 - gait.duty + latest(gait) - kSetOut;
  return (kStridesToSpeed + kStridesToStop) / 2 - lasts;
}

double four_leg_frames(const FourLegGait& gait, int strides, double period) {
  return std::ceil(first_landing(gait, period) + (strides + latest(gait) + kFourLegSettle) * period);
}

std::vector<Posture> four_leg_postures(const Body& body, const Posture& start, const FourLegGait& gait,
                                       const FourLegStyle& style, const Errand& errand, double period,
                                       std::uint32_t first_frame, const std::string& doing) {
  std::vector<Posture> postures;
  Posture posture = start;
  for (const Stance& stance : Strider(body, start, gait, style, errand, period).stances()) {
    take_stance(body, stance, posture, doing + " at frame " + std::to_string(first_frame + postures.size()),
                kFourLegRemedy);
    postures.push_back(posture);
  }
  return postures;
}

}  // namespace mars::motion
