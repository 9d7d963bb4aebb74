#include "host/content/animator/motion/gait.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/curve.h"
#include "host/content/animator/motion/stiff_legs.h"

namespace mars::motion {
namespace {

// An ordinary man's walk. Times are shares of the time from landing to landing, lengths of a leg's length.
constexpr double kStride = 0.616;      // a step
constexpr double kFlat = 1.0 / 6;      // until the sole is down
constexpr double kRise = 0.5;          // the heel rises before the toes leave
constexpr double kStrike = -20;        // degrees of the sole as the heel comes down
constexpr double kOff = 50;            // and as the toes leave
constexpr double kTipOff = 24;         // of feet without toes
constexpr double kReach = 0.9992;      // of a leg that stands: never quite straight
constexpr double kSwingReach = 0.988;  // of one that swings: its knee does not snap
constexpr double kClearance = 0.012;   // of swinging feet over the floor, at least
constexpr double kLiftTime = 0.12;     // of a swing, until they have it
constexpr double kUpright = 0.02;      // of a swing, at either end, that a foot moves up or down alone
constexpr double kStiffRise = 0.05;    // of legs without knees, as the pelvis rolls
constexpr double kStiffRoll = 0.2;     // sine of that, at most
constexpr double kStiffLift = 0.02;    // of such legs at least, if need be round the outside
constexpr CurvePoint kPitches[] = {{0, 50}, {0.184, 63}, {0.424, 38}, {0.688, 0}, {0.88, -19}, {1, -20}};
constexpr CurvePoint kRises[] = {{0, 0.070}, {0.1, 0.112}, {0.28, 0.136}, {0.52, 0.093}, {0.76, 0.031}, {1, 0.017}};
constexpr CurvePoint kBends[] = {{0, -50}, {0.2, -46}, {0.328, -18}, {0.472, -3}, {0.664, 0}, {1, 0}};

glm::dvec2 ahead(double heading) { return {std::cos(glm::radians(heading)), std::sin(glm::radians(heading))}; }

class Walker {
 public:
  Walker(const Body& body, const Posture& start, const Gait& gait, bool rolls)
      : body_(body), gait_(gait), rolls_(rolls), start_(stance_of(body, start)), floor_(body.floor_under(start)) {
    for (const modeler::Side side : kSides) {
      const Foot& foot = start_.feet[index_of(side)];
      prints_[index_of(side)] = {{foot.ankle.x, foot.ankle.y}, foot.heading};
    }
    for (const Step& step : gait.steps) steps_[index_of(step.side)].push_back(&step);
    for (const Waypoint& point : gait.way) headings_.push_back({point.time, point.heading});
  }

  Stance at(double time) const {
    Stance stance = body_at(time);
    for (const modeler::Side side : kSides) stance.feet[index_of(side)] = foot_at(side, time);
    return stance;
  }

  // How far the pelvis is too high for the feet that stand or swing there.
  double too_high(const Stance& stance) const {
    double most = 0;
    for (const modeler::Side side : kSides) {
      const Foot& foot = stance.feet[index_of(side)];
      const glm::dvec3 hip = hip_of(stance, side), way = hip - foot.ankle;
      const double reach = (foot.stands ? kReach : kSwingReach) * body_.leg(side).length();
      const double across = std::min(std::hypot(way.x, way.y), reach);
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

  // ---- Feet

  // How far a foot is carried, over an ordinary stride: small steps roll less and rise less.
  double zeal(const Step& step, const Footprint& from) const {
    const double far = glm::distance(step.to.place, from.place) / (2 * kStride * body_.leg_length());
    return 0.35 + 0.65 * std::min(far, 1.2);
  }

  double off_pitch(const Step& step, const Footprint& from, modeler::Side side) const {
    if (body_.stiff()) return 0;
    return (body_.leg(side).toes == modeler::kNone ? kTipOff : kOff) * std::min(zeal(step, from), 1.0);
  }

  double strike_pitch(const Step& step, const Footprint& from) const {
    if (body_.stiff()) return 0;
    const double forward =
        glm::dot(step.to.place - from.place, ahead(step.to.heading)) / (2 * kStride * body_.leg_length());
    return kStrike * std::clamp(forward * 1.25 - 0.25, 0.0, 1.0);
  }

  // A foot on its print, rolled about a point of its sole that stays where it is.
  Foot rolled(modeler::Side side, const Footprint& print, const glm::dvec3& pivot, double pitch, double bent) const {
    const Sole& sole = body_.leg(side).sole;
    const glm::dvec3 shift = pivot - canonical_turn(0, pitch, 0) * pivot;
    const glm::dvec2 place = print.place + shift.x * ahead(print.heading);
    return {{place.x, place.y, floor_ + sole.height(pitch, bent)}, print.heading, pitch, bent, true};
  }

  Foot standing(modeler::Side side, const Footprint& print, const Step* before, const Footprint& from, const Step* next,
                double time) const {
    const Sole& sole = body_.leg(side).sole;
    const double flat = kFlat * gait_.period, rise = kRise * gait_.period;
    if (before && time < before->land + flat) {
      const double pitch = strike_pitch(*before, from) * (1 - (time - before->land) / flat);
      return rolled(side, print, sole.heel, pitch, 0);
    }
    if (!next || time < next->off - rise) return rolled(side, print, sole.heel, 0, 0);
    const double part = (time - next->off + rise) / rise, pitch = off_pitch(*next, print, side) * part * part;
    return rolled(side, print, sole.ball, pitch, body_.leg(side).toes == modeler::kNone ? 0 : -pitch);
  }

  Foot swinging(modeler::Side side, const Footprint& from, const Step& step, double time) const {
    constexpr double kMoment = 1e-4;
    const auto before = [&](double t) { return standing(side, from, nullptr, from, &step, t); };
    const auto after = [&](double t) { return standing(side, step.to, &step, from, nullptr, t); };
    const Foot off = before(step.off), land = after(step.land);
    const double span = step.land - step.off, u = (time - step.off) / span;
    Foot foot;
    for (int axis = 0; axis < 2; ++axis) {
      const double leaves = (off.ankle[axis] - before(step.off - kMoment * span).ankle[axis]) / kMoment;
      const double lands = (after(step.land + kMoment * span).ankle[axis] - land.ankle[axis]) / kMoment;
      foot.ankle[axis] = carried(off.ankle[axis], leaves, land.ankle[axis], lands, u);
    }
    foot.heading = from.heading + std::remainder(step.to.heading - from.heading, 360.0) * smooth(0, 1, u);
    const double way = curve_through(kPitches, 60, 0, u);
    foot.pitch = way > 0 ? way * off.pitch / kOff : way * land.pitch / kStrike;
    foot.bent = off.bent == 0 ? 0 : -curve_through(kBends, 0, 0, u) * off.bent / kOff;
    foot.stands = false;
    const glm::dvec2 forward = ahead(foot.heading);
    const double aside = sign_of(side) * round_about(side) * std::sin(std::numbers::pi * u);
    foot.ankle += glm::dvec3(-forward.y * aside, forward.x * aside, 0);
    foot.ankle.z = floor_ +
                   std::max(rise(step, from, off, land, u) * body_.leg_length(),
                            body_.leg(side).sole.height(foot.pitch, foot.bent) - body_.leg(side).sole.height(0, 0) +
                                std::min({1.0, u / kLiftTime, (1 - u) / kLiftTime}) * kClearance * body_.leg_length()) +
                   body_.leg(side).sole.height(0, 0);
    return foot;
  }

  // A foot goes up before it goes forward, and comes down when it is there.
  static double carried(double from, double leaves, double to, double lands, double u) {
    if (u < kUpright) return from + leaves * u;
    if (u > 1 - kUpright) return to - lands * (1 - u);
    return hermite({kUpright, from + leaves * kUpright}, {1 - kUpright, to - lands * kUpright}, leaves, lands, u);
  }

  // Of the ankle over where it is when the foot is flat.
  double rise(const Step& step, const Footprint& from, const Foot& off, const Foot& land, double u) const {
    const double lift = zeal(step, from) * gait_.style.knee_lift, leg = body_.leg_length();
    const double flat = floor_ + body_.leg(step.side).sole.height(0, 0);
    std::vector<CurvePoint> points(std::begin(kRises), std::end(kRises));
    for (CurvePoint& point : points) point[1] *= lift;
    points.front()[1] = (off.ankle.z - flat) / leg;
    points.back()[1] = (land.ankle.z - flat) / leg;
    return curve_through(points, 0.6 * lift, -0.1 * lift, u);
  }

  Foot foot_at(modeler::Side side, double time) const {
    const auto& steps = steps_[index_of(side)];
    const auto down = [](double at, const Step* step) { return at < step->land; };
    const auto next = std::upper_bound(steps.begin(), steps.end(), time, down);
    const auto landed = next - steps.begin();
    const Footprint& start = prints_[index_of(side)];
    const Footprint& print = landed > 0 ? next[-1]->to : start;
    if (next != steps.end() && time > (*next)->off) return swinging(side, print, **next, time);
    const Footprint& from = landed > 1 ? next[-2]->to : start;
    return standing(side, print, landed > 0 ? next[-1] : nullptr, from, next == steps.end() ? nullptr : *next, time);
  }

  // ---- The rest of the body

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
    const double swing = full * std::min(gait_.stride / kStride, 1.2);
    const auto wave = [&](double at, double times = 1) { return std::cos(2 * std::numbers::pi * times * (p - at)); };
    const double loose = body_.planar() || body_.stiff() ? 0 : 1;  // a figure that cannot sway does not
    move_along(time, stance);
    const double settle = smooth(0, gait_.steps.front().land, time);
    const double height = start_.pelvis.z - floor_ + (body_.height - start_.pelvis.z + floor_) * settle;
    const glm::dvec2 forward = ahead(stance.heading), left(-forward.y, forward.x);
    const glm::dvec2 sway = 0.013 * leg * swing * (body_.stiff() ? 0 : wave(0.015, 2)) * forward +
                            loose * 0.0216 * leg * full * wave(0.31) * left;
    stance.pelvis.x += sway.x;
    stance.pelvis.y += sway.y;
    stance.pelvis.z = floor_ + height - leg * (0.0216 * swing + 0.0124 * swing * gait_.style.bounce * wave(0.056, 2));
    const double lean = full * gait_.style.lean;
    stance.tilt =
        (1 - settle) * start_.tilt + glm::dvec3(loose * 2.5 * swing * wave(0.18) + waddle(time),
                                                swing * (3 + wave(0.05, 2)) + 0.4 * lean, -5 * loose * swing * wave(0));
    add_trunk(stance, p, swing, lean);
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
    return sign_of(step->side) * glm::degrees(std::asin(roll(step->side))) * std::sin(std::numbers::pi * u);
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
    const auto wave = [&](double at, double times = 1) { return std::cos(2 * std::numbers::pi * times * (p - at)); };
    const auto add = [&](modeler::Trunk part, const glm::dvec3& swung, double share) {
      if (const std::size_t joint = body_.find(part); joint != modeler::kNone)
        stance.turns[joint] = canonical_turn(swing * swung + glm::dvec3(0, share * lean, 0));
    };
    add(modeler::Trunk::spine, {-2.2 * wave(0.18), 0.5, 4.5 * wave(0.02)}, 0.3);
    add(modeler::Trunk::chest, {-1.4 * wave(0.18), 1.5 - 0.8 * wave(0.1, 2), 5.5 * wave(0.04)}, 0.3);
    add(modeler::Trunk::neck, {0.6 * wave(0.18), 1, -2.6 * wave(0.05)}, -0.4);
    add(modeler::Trunk::head, {0.5 * wave(0.18), -4, -2.4 * wave(0.05)}, -0.5);
  }

  void add_arm(Stance& stance, modeler::Side side, double p, double swing) const {
    const double own = side == modeler::Side::left ? p : p + 0.5, s = sign_of(side),
                 much = swing * gait_.style.arm_swing;
    const auto wave = [&](double late) { return std::cos(2 * std::numbers::pi * (own - late)); };
    if (const std::size_t joint = body_.find(modeler::Limb::shoulder, side); joint != modeler::kNone)
      stance.turns[joint] = hanging_shoulder(
          body_, side, {s * (8 + 1.5 * much * wave(0.5)), -3 * swing + 21 * much * wave(0.02), s * -12});
    if (const std::size_t joint = body_.find(modeler::Limb::elbow, side); joint != modeler::kNone)
      stance.turns[joint] = hanging_elbow(body_, side, {0, -14 - 14 * swing + 15 * much * wave(0.09), s * -14});
    if (const std::size_t joint = body_.find(modeler::Limb::wrist, side); joint != modeler::kNone)
      stance.turns[joint] = hanging_elbow(body_, side, {s * (-6 + 5 * much * wave(0.2)), 4 + 5 * much * wave(0.16), 0});
  }

  const Body& body_;
  const Gait& gait_;
  bool rolls_;  // the pelvis, to lift legs of one piece
  Stance start_;
  double floor_;
  std::array<Footprint, 2> prints_;
  std::array<std::vector<const Step*>, 2> steps_;  // of each foot
  std::vector<CurvePoint> headings_;
};

// The lowest curve over all values that changes no faster than a moving mean over `reach` values to each
// side.
std::vector<double> smooth_cover(const std::vector<double>& values, int reach) {
  const auto over = [&](const std::vector<double>& from, auto take) {
    std::vector<double> result(from.size());
    for (int i = 0; i < int(from.size()); ++i) {
      const int first = std::max(0, i - reach), last = std::min(int(from.size()) - 1, i + reach);
      result[i] = take(from.begin() + first, from.begin() + last + 1);
    }
    return result;
  };
  const auto highest = over(values, [](auto a, auto b) { return *std::max_element(a, b); });
  return over(highest, [](auto a, auto b) {
    double sum = 0;
    for (auto i = a; i != b; ++i) sum += *i;
    return sum / double(b - a);
  });
}

// It begins as high as it is.
void lower_smoothly(std::vector<double>& high, const Gait& gait) {
  const std::vector<double> cover = smooth_cover(high, std::max(1, int(gait.period / 3)));
  high[0] = 0;
  for (std::size_t frame = 1; frame < high.size(); ++frame)
    high[frame] = std::max(high[frame], cover[frame] * smooth(0, gait.steps.front().land, double(frame)));
}

}  // namespace

double swing_share(const Body& body) { return body.stiff() ? 1.0 : 5.0 / 6; }

std::map<std::size_t, glm::dmat3> at_ease(const Body& body) {
  std::map<std::size_t, glm::dmat3> turns;
  for (const modeler::Trunk part :
       {modeler::Trunk::spine, modeler::Trunk::chest, modeler::Trunk::neck, modeler::Trunk::head})
    if (const std::size_t joint = body.find(part); joint != modeler::kNone) turns[joint] = glm::dmat3(1);
  for (const modeler::Side side : kSides) {
    const double s = sign_of(side);
    const auto add = [&](modeler::Limb limb, const glm::dmat3& turn) {
      if (const std::size_t joint = body.find(limb, side); joint != modeler::kNone) turns[joint] = turn;
    };
    add(modeler::Limb::shoulder, hanging_shoulder(body, side, {s * 8, 0, s * -12}));
    add(modeler::Limb::elbow, hanging_elbow(body, side, {0, -14, s * -14}));
    add(modeler::Limb::wrist, hanging_elbow(body, side, {s * -6, 4, 0}));
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
  lower_smoothly(high, gait);
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
