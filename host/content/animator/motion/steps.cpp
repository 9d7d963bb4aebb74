#include "host/content/animator/motion/steps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/gait.h"
#include "host/content/animator/motion/glide.h"

namespace mars::motion {
namespace {

constexpr double kStride = 0.616;      // of a leg: an ordinary step
constexpr double kPace = 2;            // steps a second
constexpr double kLead = 0.35;         // of a period: weight goes to one foot before the first step
constexpr double kSettle = 0.5;        // and to both after the last
constexpr double kBehind = 0.526;      // of a step: the pelvis is behind the foot that lands
constexpr double kFirstBehind = 0.44;  // the first foot, from standing
constexpr double kApart = 0.67;        // of the hips' width: feet of a walk
constexpr double kToeOut = 6;          // degrees
constexpr double kTurnAtOnce = 50;     // degrees between two feet
constexpr double kLeastAtOnce = 6;     // where the joints' limits want less
constexpr int kBowTries = 4;           // each with twice as many steps
constexpr std::uint32_t kMostSteps = 10000;
constexpr double kUpright = 0.8;  // of its height: what is lower sits
constexpr double kNothing = 0.2;  // degrees
constexpr double kOnTheWay = 25;  // degrees that the first step can turn

constexpr const char* kWalkRemedy = "take shorter steps (step-length), or widen the joint's limits in its model";
constexpr const char* kBowRemedy =
    "take more and shorter steps (steps, distance), or widen the joint's limits in its model";
constexpr const char* kTurnRemedy =
    "widen the joint's limits in its model, or key its turn: mars animate FILM pose ACTOR turn.z=90";

glm::dvec2 ahead(double heading) { return {std::cos(glm::radians(heading)), std::sin(glm::radians(heading))}; }
glm::dvec2 left_of(const glm::dvec2& v) { return {-v.y, v.x}; }

// Where a body stands, as steps see it.
struct Stand {
  glm::dvec2 middle;  // between its feet
  double heading;
};

Stand stand_of(const Stance& stance) {
  const glm::dvec3 middle = 0.5 * (stance.feet[0].ankle + stance.feet[1].ankle);
  return {{middle.x, middle.y}, stance.heading};
}

// Circles are paths, too: `bend` degrees over the whole length.
struct Path {
  Stand start;
  double length;
  double bend;

  double heading(double s) const { return start.heading + bend * s / length; }
  glm::dvec2 at(double s) const {
    const double half = glm::radians(bend * s / length) / 2;
    const double chord = std::abs(half) < 1e-6 ? s : s * std::sin(half) / half;
    return start.middle + chord * ahead(start.heading + glm::degrees(half));
  }
};

class Planner {
 public:
  Planner(const Body& body, double period) : body_(body), period_(period) {
    const Posture drawn = drawn_posture(*body.model);
    const glm::dvec3 way =
        frame_in(*body.model, drawn, body.legs[0].ankle).place - frame_in(*body.model, drawn, body.pelvis).place;
    forward_ = (glm::transpose(body.axes) * way).x;
    double inner = 0;
    for (const glm::dvec3& point : body.legs[0].sole.foot) inner = std::max(inner, -point.y);
    const double hips = std::abs(body.legs[0].aside);
    apart_ = body.planar() ? hips : std::max(kApart * hips, std::min(hips, 1.15 * inner));
    toe_out_ = body.model->joints[body.legs[0].hip].freedoms() == 3 ? kToeOut : 0;
  }

  Footprint print(const glm::dvec2& place, double heading, modeler::Side side) const {
    return {place + sign_of(side) * apart_ * left_of(ahead(heading)), heading + sign_of(side) * toe_out_};
  }

  Waypoint waypoint(double time, const glm::dvec2& middle, double heading, double speed) const {
    return {time, middle - forward_ * ahead(heading), heading, speed * ahead(heading)};
  }

  // The k-th landing, from 1; its swing before it.
  Step step(int k, modeler::Side side, const Footprint& to) const {
    const double land = landing(k);
    return {side, to, land - std::round(swing_share(body_) * period_), land};
  }

  // In whole frames, so that a film shows the foot as it comes down.
  double landing(int k) const { return std::round(kLead * period_) + k * period_; }

 private:
  const Body& body_;
  double period_;
  double forward_;  // of the ankles, from the pelvis
  double apart_;    // of an ankle from the middle
  double toe_out_;
};

Gait walk_gait(const Body& body, const Stance& from, const Path& path, int steps, double period, modeler::Side first,
               const Style& style) {
  const Planner planner(body, period);
  const double length = path.length / steps, speed = length / period;
  const double behind = body.stiff() ? 0.5 : kBehind;
  Gait gait{{}, {}, period, length / body.leg_length(), style};
  gait.way.push_back({0, {from.pelvis.x, from.pelvis.y}, from.heading, {0, 0}});
  modeler::Side side = first;
  for (int k = 1; k <= steps; ++k, side = other(side)) {
    gait.steps.push_back(planner.step(k, side, planner.print(path.at(k * length), path.heading(k * length), side)));
    const double s = (k - (k == 1 && !body.stiff() ? kFirstBehind : behind)) * length;
    gait.way.push_back(planner.waypoint(planner.landing(k), path.at(s), path.heading(s), speed));
  }
  const double end = path.heading(path.length);
  gait.steps.push_back(planner.step(steps + 1, side, planner.print(path.at(path.length), end, side)));
  const double near = path.length - 0.06 * length;
  gait.way.push_back(planner.waypoint(planner.landing(steps + 1), path.at(near), path.heading(near), 0.12 * speed));
  gait.way.push_back(
      planner.waypoint(std::ceil(planner.landing(steps + 1) + kSettle * period), path.at(path.length), end, 0));
  return gait;
}

Gait turn_gait(const Body& body, const Stance& from, double by, double at_once, double period) {
  const Planner planner(body, period);
  const Stand start = stand_of(from);
  const int pairs = std::max(1, static_cast<int>(std::ceil(std::abs(by) / at_once)));
  Gait gait{{}, {}, period, 0.3 * kStride, {}};
  gait.way.push_back({0, {from.pelvis.x, from.pelvis.y}, from.heading, {0, 0}});
  for (int k = 1; k <= 2 * pairs; ++k) {
    const bool leads = k % 2 == 1;
    const modeler::Side side = (by > 0) == leads ? modeler::Side::left : modeler::Side::right;
    const int pair = (k + 1) / 2;
    const double heading = start.heading + by * pair / pairs;
    gait.steps.push_back(planner.step(k, side, planner.print(start.middle, heading, side)));
    gait.way.push_back(
        planner.waypoint(planner.landing(k), start.middle, start.heading + by * (k - 0.5) / (2 * pairs), 0));
  }
  gait.way.push_back(
      planner.waypoint(std::ceil(planner.landing(2 * pairs) + kSettle * period), start.middle, start.heading + by, 0));
  return gait;
}

// Postures so far, and the body that goes on from the last.
class Going {
 public:
  Going(const Scene& scene, const char* command)
      : scene_(scene),
        command_(command),
        body_(body_of(scene.model(), scene.actor.name, command)),
        period_(std::max(4.0, std::round(scene.film.rate / scene.arguments.number("pace", kPace, {0.1, 10})))) {
    postures_.push_back(posture_of(scene));
    const Stance stance = now();
    if (stance.pelvis.z - body_.floor_under(postures_[0]) < kUpright * body_.height)
      throw Failure("does not stand at frame " + std::to_string(scene.at),
                    "actor '" + scene.actor.name + "', " + command,
                    "let it stand up first, by the action stand; to do it again otherwise, give --at with the "
                    "frame where it began");
  }

  Stance now() const { return stance_of(body_, postures_.back()); }
  const Body& body() const { return body_; }
  double period() const { return period_; }

  // Refuses what cannot be walked whatever the joints allow, before a posture is sought.
  void require_possible(const Gait& gait, const char* remedy) const {
    scene_.last_after(double(postures_.size() - 1) + gait.end());
    const double reach = 2 * body_.leg_length();
    for (std::size_t i = 1; i < gait.steps.size(); ++i)
      if (const double step = glm::distance(gait.steps[i].to.place, gait.steps[i - 1].to.place); step > reach)
        throw Failure("would take a step of " + document::shown(step) + ", where two legs of " +
                          document::shown(body_.leg_length()) + " reach " + document::shown(reach) + " at most",
                      scene_.where(), remedy);
  }

  void go(const Gait& gait, const char* remedy) {
    require_possible(gait, remedy);
    const Posture start = postures_.back();
    std::vector<Posture> more =
        postures_of(body_, start, gait, scene_.at + std::uint32_t(postures_.size()) - 1, command_, remedy);
    begin_at(*body_.model, start, gait.steps.front().off, more);
    postures_.insert(postures_.end(), more.begin() + 1, more.end());
  }

  // By steps that turn less, where limits want it.
  void turn(double by) {
    require_possible(turn_gait(body_, now(), by, kTurnAtOnce, period_), kTurnRemedy);
    for (double at_once = kTurnAtOnce;; at_once /= 2) try {
        return go(turn_gait(body_, now(), by, at_once, period_), kTurnRemedy);
      } catch (const Failure&) {
        if (at_once / 2 < kLeastAtOnce) throw;
      }
  }

  Motion motion() const {
    return {keys_of(body_, body_.joints(), postures_, scene_.at), scene_.at + std::uint32_t(postures_.size()) - 1, ""};
  }

 private:
  const Scene& scene_;
  const char* command_;
  Body body_;
  double period_;
  std::vector<Posture> postures_;
};

double bearing(const Stand& from, const glm::dvec3& to) {
  const glm::dvec2 way = glm::dvec2(to.x, to.y) - from.middle;
  return std::remainder(glm::degrees(std::atan2(way.y, way.x)) - from.heading, 360.0);
}

Style style_of(const Arguments& arguments) {
  return {arguments.number("arm-swing", 1, {0, 3}), arguments.number("bounce", 1, {0, 3}),
          arguments.number("knee-lift", 1, {0, 3}), arguments.number("lean", 0, {-30, 45})};
}

// As many steps as the way takes, if it is so long.
std::uint32_t steps_for(const Arguments& arguments, double way, double step) {
  const double steps = std::max(1.0, std::round(way / step));
  if (steps > kMostSteps)
    arguments.refuse(arguments.has("to") ? "to" : "distance",
                     "is " + document::shown(way) + " away, which takes " + document::shown(steps) + " steps of " +
                         document::shown(step),
                     "a walk has at most " + std::to_string(kMostSteps) + ": go to a nearer place");
  return static_cast<std::uint32_t>(steps);
}

void refuse_both(const Arguments& arguments, std::string_view one, std::string_view other) {
  if (arguments.has(one) && arguments.has(other))
    arguments.refuse(one, "stands beside " + std::string(other), "give one of them");
}

}  // namespace

Motion walk(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  refuse_both(arguments, "to", "distance");
  refuse_both(arguments, "to", "turn");
  if (arguments.has("steps") && arguments.has("step-length")) {
    refuse_both(arguments, "steps", "distance");
    refuse_both(arguments, "steps", "to");
  }
  const std::uint32_t asked = arguments.count("steps", 4, kMostSteps);
  std::optional<double> far = arguments.number("distance", {1e-6, document::kFarthest});
  Going going(scene, "walk");
  if (const auto to = arguments.vector("to")) {
    const double by = bearing(stand_of(going.now()), *to);
    if (std::abs(by) > kOnTheWay) going.turn(by);
    far = glm::distance(stand_of(going.now()).middle, glm::dvec2(to->x, to->y));
    if (*far < 0.05 * going.body().leg_length()) return going.motion();
  }
  const double ordinary =
      arguments.number("step-length", kStride * going.body().leg_length(), {1e-6, document::kFarthest});
  std::uint32_t steps = far && !arguments.has("steps") ? steps_for(arguments, *far, ordinary) : asked;
  constexpr std::string_view sides[] = {"left", "right"};
  const modeler::Side first =
      kSides[arguments.choice("first", arguments.number("turn", 0, {-3600, 3600}) > 0 ? 0 : 1, sides)];
  Path path{stand_of(going.now()), far ? *far : steps * ordinary, arguments.number("turn", 0, {-3600, 3600})};
  if (const auto to = arguments.vector("to")) path.start.heading = path.start.heading + bearing(path.start, *to);
  const char* const remedy = arguments.has("turn") ? kBowRemedy : kWalkRemedy;
  const auto gait = [&] {
    return walk_gait(going.body(), going.now(), path, static_cast<int>(steps), going.period(), first,
                     style_of(arguments));
  };
  // A bow is walked in shorter steps, where limits want it and nobody has said how many.
  const bool may_shorten = arguments.has("turn") && !arguments.has("steps") && !arguments.has("step-length");
  for (int tries = may_shorten ? kBowTries : 1;; --tries, steps *= 2) try {
      going.go(gait(), remedy);
      return going.motion();
    } catch (const Failure&) {
      if (tries == 1) throw;
    }
}

Motion turn(const Scene& scene) {
  refuse_both(scene.arguments, "by", "to");
  Going going(scene, "turn");
  const auto to = scene.arguments.vector("to");
  const double by = to ? bearing(stand_of(going.now()), *to) : scene.arguments.number("by", 90, {-3600, 3600});
  if (std::abs(by) > kNothing) going.turn(by);
  return going.motion();
}

}  // namespace mars::motion
