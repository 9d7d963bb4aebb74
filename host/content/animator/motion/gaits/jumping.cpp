#include "host/content/animator/motion/gaits/jumping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/arms.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/gaits/going.h"
#include "host/content/animator/motion/scene/gravity.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kHeight = 0.35;                   // of the leg, that the hips rise after the feet have left
constexpr double kCrouch = 0.26;                   // of the leg, before it leaves
constexpr double kAbsorb = 0.22;                   // and after it has landed
constexpr double kGather = 0.45, kRecover = 0.55;  // seconds, for a leg of that man
constexpr double kJumpReach = 0.997;               // of a leg that leaves or lands: it is not straight
constexpr double kOffPitch = 42, kOffTip = 24, kLandPitch = 14;  // degrees of the soles
constexpr double kPush = 0.55;                                   // of the time of the push, after which the heels rise
constexpr double kShins = 20;                                    // degrees that shins lean before the hips go back
constexpr double kJumpLean = 40;                                 // degrees of the trunk in the crouch
constexpr const char* kJumpRemedy =
    "jump lower or less far (height, distance), or widen the joint's limits in its model";

// When what happens, and where the pelvis then is: constant acceleration in the push and in the landing, free
// fall between.
struct Plan {
  double gather, off, land, down, end;  // frames: crouched, feet leave, feet are down, knees bent, upright again
  double off_along, land_along;         // of the pelvis, from the feet's middle before and after
  double off_height, land_height;       // of the pelvis over the floor
  double low, lowest;                   // of the pelvis in the crouch, and after the landing
  double along, up, gravity;            // speed as the feet leave, units a frame; units a frame and frame
};

class Jumper {
 public:
  explicit Jumper(const Scene& scene)
      : scene_(scene),
        body_(body_of(scene.model(), scene.actor.name, "jump")),
        start_(posture_of(scene)),
        from_(stance_of(body_, start_)),
        floor_(body_.floor_under(start_)),
        hang_{hang_beside(body_, modeler::Side::left), hang_beside(body_, modeler::Side::right)} {
    for (const modeler::Side side : kSides) needed(body_, modeler::Limb::knee, side, "jump");
    require_upright(scene, body_, start_);
    const Arguments& arguments = scene.arguments;
    const double leg = body_.leg_length(), rate = scene.film.rate;
    gravity_ = arguments.number("gravity", kGravityOfLegs * leg, {1e-6, document::kFarthest}) / (rate * rate);
    height_ = arguments.number("height", kHeight * leg, {1e-6, document::kFarthest});
    distance_ = arguments.number("distance", 0, {-document::kFarthest, document::kFarthest});
    turn_ = arguments.number("turn", 0, {-3600, 3600});
    pace_ = std::sqrt(kGravityOfLegs * leg / (rate * rate) / gravity_);
    plan();
    scene.last_after(plan_.end);
  }

  Motion motion() {
    std::vector<Posture> postures;
    Posture posture = start_;
    for (int frame = 0; frame <= int(plan_.end); ++frame) {
      take_stance(body_, at(frame), posture, "jump at frame " + std::to_string(scene_.at + frame), kJumpRemedy);
      postures.push_back(posture);
    }
    begin_at(*body_.model, start_, plan_.gather, postures);
    const auto hundredths = [](double value) { return document::shown(std::round(value * 100) / 100); };
    return {keys_of(body_, body_.joints(), postures, scene_.at), scene_.at + std::uint32_t(plan_.end),
            "off the floor for " + hundredths((plan_.land - plan_.off) / scene_.film.rate) + " s"};
  }

 private:
  // ---- The plan

  double pitch_off() const { return body_.legs[0].toes == modeler::kNone ? kOffTip : kOffPitch; }

  // Of the pelvis over the floor, with a leg that reaches from the pelvis to an ankle so far behind or before it.
  double standing_height(double along, double pitch, bool ball) const {
    const Leg& leg = body_.legs[0];
    const glm::dvec3 pivot = ball ? leg.sole.ball : glm::dvec3(0);
    const double shift = (pivot - canonical_turn(0, pitch, 0) * pivot).x;
    const double reach = kJumpReach * leg.length(), across = std::min(std::abs(along - shift), 0.9 * reach);
    const double upright = body_.height - leg.sole.height(0, 0) - leg.length();  // of the pelvis over the hips
    return upright + leg.sole.height(pitch, leg.toes == modeler::kNone ? 0 : -pitch) +
           std::sqrt(reach * reach - across * across);
  }

  void plan() {
    Plan& f = plan_;
    const double leg = body_.leg_length();
    f.gravity = gravity_;
    f.off_along = f.land_along = 0;
    const double first = std::max(2.0, std::round(kGather * pace_ * scene_.film.rate));
    for (int round = 0; round < 8; ++round) {  // where it leaves and lands, and how fast, depend on each other
      f.off_height = standing_height(f.off_along, pitch_off(), true);
      f.land_height = standing_height(f.land_along, kLandPitch, true);
      f.low = std::min(f.off_height, body_.height) - kCrouch * leg;
      const double top = f.off_height + height_;
      const double fall = std::sqrt(2 * std::max(0.0, top - f.land_height) / gravity_);
      const double flown = std::max(2.0, std::round(std::sqrt(2 * height_ / gravity_) + fall));
      f.up = (f.land_height - f.off_height) / flown + gravity_ * flown / 2;
      const double push = std::max(2.0, std::round(2 * (f.off_height - f.low) / f.up));
      const double down = f.up - gravity_ * flown;  // speed as it lands
      const double stop = std::max(2.0, std::round(2 * kAbsorb * leg / -down));
      f.lowest = f.land_height + down * stop / 2;
      f.along = distance_ / (flown + (push + stop) / 2);
      f.off_along = f.along * push / 2;
      f.land_along = -f.along * stop / 2;
      f.gather = first;
      f.off = first + push;
      f.land = f.off + flown;
      f.down = f.land + stop;
      f.end = f.down + std::max(2.0, std::round(kRecover * pace_ * scene_.film.rate));
    }
  }

  // ---- At a frame

  // How far behind the feet hips of this height are, so that shins lean no more than ankles bend.
  double behind(double height) const {
    const Leg& leg = body_.legs[0];
    const double upright = body_.height - leg.sole.height(0, 0) - leg.length();
    const double hips = height - upright - leg.sole.height(0, 0),
                 shins = leg.shin * elementary::cos(glm::radians(kShins));
    const double both = glm::degrees(elementary::acos(std::clamp(hips / leg.length(), 0.0, 1.0)));
    if (both < kShins) return 0;
    const double thighs = elementary::acos(std::clamp((hips - shins) / leg.thigh, -1.0, 1.0));
    return std::min(0.0, leg.shin * elementary::sin(glm::radians(kShins)) - leg.thigh * elementary::sin(thighs));
  }

  // Of the pelvis: forward from where it stands, and over the floor.
  glm::dvec2 pelvis_at(double time) const {
    const Plan& f = plan_;
    const double upright = from_.pelvis.z - floor_;
    if (time < f.gather) return {0, glm::mix(upright, f.low, smooth(0, f.gather, time))};
    if (time < f.off) {
      const double part = (time - f.gather) / (f.off - f.gather);
      return {f.off_along * part * part, hermite({0, f.low}, {1, f.off_height}, 0, f.up * (f.off - f.gather), part)};
    }
    const double t = time - f.off;
    if (time < f.land) return {f.off_along + f.along * t, f.off_height + f.up * t - f.gravity * t * t / 2};
    if (time < f.down) {
      const double left = (f.down - time) / (f.down - f.land);
      return {distance_ + f.land_along * left * left, glm::mix(f.lowest, f.land_height, left * left)};
    }
    return {distance_, glm::mix(f.lowest, body_.height, smooth(f.down, f.end, time))};
  }

  Foot standing(const glm::dvec2& place, const Leg& leg, double heading, double pitch) const {
    const glm::dvec3 pivot = leg.sole.ball, shift = pivot - canonical_turn(0, pitch, 0) * pivot;
    const double bent = leg.toes == modeler::kNone ? 0 : -pitch;
    const glm::dvec2 ankle = place + shift.x * ahead_of(heading);
    return {{ankle.x, ankle.y, floor_ + leg.sole.height(pitch, bent)}, heading, pitch, bent};
  }

  Foot foot_at(modeler::Side side, double time) const {
    const Plan& f = plan_;
    const Leg& leg = body_.leg(side);
    const Foot& first = from_.feet[index_of(side)];
    const glm::dvec2 middle = 0.5 * glm::dvec2(from_.feet[0].ankle + from_.feet[1].ankle);
    const glm::dvec3 aside = canonical_turn(0, 0, turn_) * (first.ankle - glm::dvec3(middle, 0));
    const glm::dvec2 place(first.ankle), there = middle + distance_ * ahead_of(from_.heading) + glm::dvec2(aside);
    const double heels = glm::mix(f.gather, f.off, kPush), down = f.land + 0.5 * (f.down - f.land);
    const double rising = time <= heels ? 0 : std::min(1.0, (time - heels) / (f.off - heels));
    if (time <= f.off) return standing(place, leg, first.heading, pitch_off() * rising * rising);
    if (time >= f.land)
      return standing(there, leg, first.heading + turn_, kLandPitch * (1 - smooth(f.land, down, time)));
    return flying(side, standing(place, leg, first.heading, pitch_off()),
                  standing(there, leg, first.heading + turn_, kLandPitch), time);
  }

  // Carried by the hips: it hangs, and is drawn up.
  Foot flying(modeler::Side side, const Foot& off, const Foot& land, double time) const {
    const Plan& f = plan_;
    const double u = (time - f.off) / (f.land - f.off), way = smooth(0, 1, u);
    const glm::dvec2 begin = pelvis_at(f.off), end = pelvis_at(f.land), now = pelvis_at(time);
    const glm::dvec3 forward(ahead_of(from_.heading), 0), up(0, 0, 1);
    const auto moved = [&](const Foot& foot, const glm::dvec2& pelvis) {
      return foot.ankle + (now.x - pelvis.x) * forward + (now.y - pelvis.y) * up;
    };
    Foot foot;
    foot.ankle = glm::mix(moved(off, begin), moved(land, end), way);
    const double drawn = (0.10 + 0.25 * std::min(1.0, std::abs(distance_) / body_.leg_length())) * body_.leg_length();
    foot.ankle += drawn * elementary::pow(elementary::sin(std::numbers::pi * u), 2) * up;
    foot.heading = off.heading + turn_ * way;
    foot.pitch = glm::mix(off.pitch, land.pitch, way) + 14 * elementary::sin(std::numbers::pi * u);
    foot.bent = glm::mix(off.bent, land.bent, smooth(0, 0.5, u));
    foot.stands = false;
    const Sole& sole = body_.leg(side).sole;
    const double clear = 0.02 * body_.leg_length() * std::min({1.0, 6 * u, 6 * (1 - u)});
    foot.ankle.z = std::max(foot.ankle.z, floor_ + sole.height(foot.pitch, foot.bent) + clear);
    return foot;
  }

  Stance at(double time) const {
    const Plan& f = plan_;
    Stance stance;
    const double way = smooth(f.off, f.land, time);
    const glm::dvec2 pelvis = pelvis_at(time), back = behind(pelvis.y) * ahead_of(from_.heading + turn_ * way);
    const glm::dvec2 along =
        pelvis.x * ahead_of(from_.heading) + (time < f.off || time > f.land ? back : glm::dvec2(0));
    stance.heading = from_.heading + turn_ * way;
    const glm::dvec3 landed = 0.5 * (from_.feet[0].ankle + from_.feet[1].ankle);
    const glm::dvec3 off = canonical_turn(0, 0, turn_ * way) * (from_.pelvis - landed);
    stance.pelvis = {landed.x + off.x + along.x, landed.y + off.y + along.y, floor_ + pelvis.y};
    const double crouched = smooth(0, f.gather, time) * (1 - smooth(f.gather, f.off, time)),
                 sunk = smooth(f.land - 2, f.down, time) * (1 - smooth(f.down, f.end, time));
    const double lean = kJumpLean * (crouched + 0.8 * sunk);
    stance.tilt = (1 - smooth(0, f.gather, time)) * from_.tilt + glm::dvec3(0, 0.6 * lean, 0);
    add_trunk(stance, lean);
    straighten_between(body_, stance);
    for (const modeler::Side side : kSides) {
      add_arm(stance, side, time);
      stance.feet[index_of(side)] = foot_at(side, time);
    }
    return stance;
  }

  void add_trunk(Stance& stance, double lean) const {
    const auto add = [&](modeler::Trunk part, double share) {
      if (const std::size_t joint = body_.find(part); joint != modeler::kNone)
        stance.turns[joint] = canonical_turn(0, share * lean, 0);
    };
    add(modeler::Trunk::spine, 0.25);
    add(modeler::Trunk::chest, 0.2);
    add(modeler::Trunk::neck, -0.35);
    add(modeler::Trunk::head, -0.4);
  }

  // Back in the crouch, forward and up with the push, down as it lands.
  void add_arm(Stance& stance, modeler::Side side, double time) const {
    const Plan& f = plan_;
    const double s = sign_of(side), top = glm::mix(f.off, f.land, 0.35);
    const CurvePoint swings[] = {
        {0, 0},      {0.8 * f.gather, 48}, {f.gather, 50}, {glm::mix(f.gather, f.off, 0.9), -75},
        {top, -115}, {f.land, -62},        {f.down, -18},  {f.end, 0}};
    const CurvePoint bends[] = {{0, 0}, {f.gather, 12}, {f.off, 30}, {f.land, 28}, {f.down, 26}, {f.end, 0}};
    const double swing = curve_through(swings, 0, 0, time), bend = curve_through(bends, 0, 0, time);
    const auto add = [&](modeler::Limb limb, const glm::dmat3& turn) {
      if (const std::size_t joint = body_.find(limb, side); joint != modeler::kNone) stance.turns[joint] = turn;
    };
    add(modeler::Limb::shoulder, hanging_shoulder(body_, side, {s * (hang_[index_of(side)] + 1), swing, s * -12}));
    add(modeler::Limb::elbow, hanging_elbow(body_, side, {0, -14 - bend, s * -14}));
    add(modeler::Limb::wrist, hanging_wrist(body_, side, {s * -6, 4, 0}));
  }

  const Scene& scene_;
  Body body_;
  Posture start_;
  Stance from_;
  double floor_;
  std::array<double, 2> hang_;  // of left and right arm, degrees
  double gravity_, height_, distance_, turn_;
  double pace_;  // times an ordinary one's, by its gravity
  Plan plan_;
};

}  // namespace

Motion jump(const Scene& scene) {
  require_two_legs(scene.model(), scene.actor.name, "jump");
  return Jumper(scene).motion();
}

}  // namespace mars::motion
