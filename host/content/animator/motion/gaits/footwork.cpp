#include "host/content/animator/motion/gaits/footwork.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kLiftTime = 0.12;  // of a swing, until a foot is as high as it must be
constexpr double kVertical = 0.02;  // of a swing, at either end, that a foot moves up or down alone

// A foot goes up before it goes forward, and comes down when it is there.
double carried(double from, double leaves, double to, double lands, double u) {
  if (u < kVertical) return from + leaves * u;
  if (u > 1 - kVertical) return to - lands * (1 - u);
  return hermite({kVertical, from + leaves * kVertical}, {1 - kVertical, to - lands * kVertical}, leaves, lands, u);
}

// A course times `times` that begins and ends elsewhere.
double bent_to(const Course& course, double times, double first, double last, double u) {
  std::vector<CurvePoint> points(course.points.begin(), course.points.end());
  for (CurvePoint& point : points) point[1] *= times;
  points.front()[1] = first;
  points.back()[1] = last;
  return curve_through(points, course.first_slope * times, course.last_slope * times, u);
}

}  // namespace

// How far a foot is carried, over an ordinary stride: small steps roll less and rise less.
double Footwork::zeal(const Step& step, const Footprint& from) const {
  const double far = glm::distance(step.to.place, from.place) / (2 * footing_.tread.stride * footing_.leg.length());
  return 0.35 + 0.65 * std::min(far, 1.2);
}

double Footwork::off_pitch(const Step& step, const Footprint& from) const {
  if (footing_.leg.knee == modeler::kNone) return 0;
  return (footing_.leg.toes == modeler::kNone ? footing_.tread.tip_off : footing_.tread.off) *
         std::min(zeal(step, from), 1.0);
}

double Footwork::strike_pitch(const Step& step, const Footprint& from) const {
  if (footing_.leg.knee == modeler::kNone) return 0;
  const double forward = glm::dot(step.to.place - from.place, ahead_of(step.to.heading)) /
                         (2 * footing_.tread.stride * footing_.leg.length());
  return footing_.tread.strike * std::clamp(forward * 1.25 - 0.25, 0.0, 1.0);
}

// A foot on its print, rolled about a point of its sole that stays where it is.
Foot Footwork::rolled(const Footprint& print, const glm::dvec3& pivot, double pitch, double bent) const {
  const glm::dvec3 shift = pivot - canonical_turn(0, pitch, 0) * pivot;
  const glm::dvec2 place = print.place + shift.x * ahead_of(print.heading);
  return {{place.x, place.y, footing_.floor + footing_.leg.sole.height(pitch, bent)}, print.heading, pitch, bent, true};
}

Foot Footwork::standing(const Footprint& print, const Step* before, const Footprint& from, const Step* next,
                        double time) const {
  const Sole& sole = footing_.leg.sole;
  const double flat = footing_.tread.flat * footing_.period, rise = footing_.tread.rise * footing_.period;
  if (before && time < before->land + flat) {
    const double pitch = strike_pitch(*before, from) * (1 - (time - before->land) / flat);
    return rolled(print, sole.heel, pitch, sole.on_toes ? -pitch : 0);
  }
  if (!next || time < next->off - rise) return rolled(print, sole.heel, 0, 0);
  const double part = (time - next->off + rise) / rise, pitch = off_pitch(*next, print) * part * part;
  return rolled(print, sole.ball, pitch, footing_.leg.toes == modeler::kNone ? 0 : -pitch);
}

Foot Footwork::swinging(const Footprint& from, const Step& step, double time) const {
  constexpr double kMoment = 1e-4;
  const Tread& tread = footing_.tread;
  const Sole& sole = footing_.leg.sole;
  const auto before = [&](double t) { return standing(from, nullptr, from, &step, t); };
  const auto after = [&](double t) { return standing(step.to, &step, from, nullptr, t); };
  const Foot off = before(step.off), land = after(step.land);
  const double span = step.land - step.off, u = (time - step.off) / span;
  Foot foot;
  for (int axis = 0; axis < 2; ++axis) {
    const double leaves = (off.ankle[axis] - before(step.off - kMoment * span).ankle[axis]) / kMoment;
    const double lands = (after(step.land + kMoment * span).ankle[axis] - land.ankle[axis]) / kMoment;
    foot.ankle[axis] = carried(off.ankle[axis], leaves, land.ankle[axis], lands, u);
  }
  foot.heading = from.heading + std::remainder(step.to.heading - from.heading, 360.0) * smooth(0, 1, u);
  const double way = tread.pitches.at(u);
  foot.pitch = way > 0 ? way * off.pitch / tread.off : way * land.pitch / tread.strike;
  foot.bent = off.bent == 0 ? 0 : bent_to(tread.bends, -off.bent / tread.off, off.bent, land.bent, u);
  foot.stands = false;
  const glm::dvec2 forward = ahead_of(foot.heading);
  const double aside = footing_.aside * elementary::sin(std::numbers::pi * u);
  foot.ankle += glm::dvec3(-forward.y * aside, forward.x * aside, 0);
  const double clear = std::min({1.0, u / kLiftTime, (1 - u) / kLiftTime}) * tread.clearance * footing_.leg.length();
  foot.ankle.z = footing_.floor + std::max(rise(step, from, off, land, u) * footing_.leg.length() + sole.height(0, 0),
                                           sole.height(foot.pitch, foot.bent) + clear);
  return foot;
}

// Of the ankle over where it is when the foot is flat.
double Footwork::rise(const Step& step, const Footprint& from, const Foot& off, const Foot& land, double u) const {
  const double leg = footing_.leg.length(), flat = footing_.floor + footing_.leg.sole.height(0, 0);
  return bent_to(footing_.tread.rises, zeal(step, from) * footing_.lift, (off.ankle.z - flat) / leg,
                 (land.ankle.z - flat) / leg, u);
}

Foot Footwork::at(double time) const {
  const auto down = [](double at, const Step& step) { return at < step.land; };
  const auto next = std::upper_bound(steps_.begin(), steps_.end(), time, down);
  const auto landed = next - steps_.begin();
  const Footprint& print = landed > 0 ? next[-1].to : start_;
  if (next != steps_.end() && time > next->off) return swinging(print, *next, time);
  const Footprint& from = landed > 1 ? next[-2].to : start_;
  return standing(print, landed > 0 ? &next[-1] : nullptr, from, next == steps_.end() ? nullptr : &*next, time);
}

}  // namespace mars::motion
