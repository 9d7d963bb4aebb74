#include "host/content/animator/motion/gaits/going.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kApart = 0.67;          // of the hips' width: feet of a walk
constexpr double kToeOut = 6;            // degrees
constexpr double kTurnBetweenFeet = 50;  // degrees between two feet
constexpr double kLeastAtOnce = 6;       // where the joints' limits want less
constexpr int kBowTries = 4;             // each with twice as many steps
constexpr double kFirstStepTurn = 25;    // degrees that the first step can turn

constexpr const char* kStepRemedy = "take shorter steps (step-length), or widen the joint's limits in its model";
constexpr const char* kBowRemedy =
    "take more and shorter steps (steps, distance), or widen the joint's limits in its model";
constexpr const char* kTurnRemedy =
    "widen the joint's limits in its model, or key its turn: mars animate FILM pose ACTOR turn.z=90";

// As many steps as the way takes, if it is so long.
std::uint32_t steps_for(const Arguments& arguments, double way, double step) {
  const double steps = std::max(1.0, std::round(way / step));
  if (steps > kMostSteps)
    arguments.refuse(arguments.has("to") ? "to" : "distance",
                     "is " + document::shown(way) + " away, which takes " + document::shown(steps) + " steps of " +
                         document::shown(step),
                     "a way has at most " + std::to_string(kMostSteps) + ": go to a nearer place");
  return static_cast<std::uint32_t>(steps);
}

Gait turn_gait(const Body& body, const Stance& from, double by, double at_once, double period) {
  const Planner planner(body, walking(), period, kWalkLead);
  const Stand start = stand_of(from);
  const int pairs = std::max(1, static_cast<int>(std::ceil(std::abs(by) / at_once)));
  Gait gait{{}, {}, period, 0.3 * walking().tread.stride, {}};
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
  gait.way.push_back(planner.waypoint(std::ceil(planner.landing(2 * pairs) + kWalkSettle * period), start.middle,
                                      start.heading + by, 0));
  return gait;
}

}  // namespace

void require_upright(const Scene& scene, const Body& body, const Posture& posture) {
  if (body.is_upright(posture)) return;
  throw Failure(
      "does not stand at frame " + std::to_string(scene.at), scene.where(),
      "let it stand up first, by the action stand; to do it again otherwise, give --at with the frame where it "
      "began");
}

Stand stand_of(const Stance& stance) {
  const glm::dvec3 middle = 0.5 * (stance.feet[0].ankle + stance.feet[1].ankle);
  return {{middle.x, middle.y}, stance.heading};
}

double bearing(const Stand& from, const glm::dvec3& to) {
  const glm::dvec2 way = glm::dvec2(to.x, to.y) - from.middle;
  return std::remainder(glm::degrees(elementary::atan2(way.y, way.x)) - from.heading, 360.0);
}

glm::dvec2 Path::at(double s) const {
  const double half = glm::radians(bend * s / length) / 2;
  const double chord = std::abs(half) < 1e-6 ? s : s * elementary::sin(half) / half;
  return start.middle + chord * ahead_of(start.heading + glm::degrees(half));
}

Planner::Planner(const Body& body, const Manner& manner, double period, double lead)
    : period_(period), lead_(lead), swing_(std::round((body.stiff() ? 1 : manner.tread.swing) * period)) {
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

Footprint Planner::print(const glm::dvec2& place, double heading, modeler::Side side, double apart) const {
  return {place + sign_of(side) * apart * apart_ * left_of(ahead_of(heading)), heading + sign_of(side) * toe_out_};
}

Waypoint Planner::waypoint(double time, const glm::dvec2& middle, double heading, double speed) const {
  return {time, middle - forward_ * ahead_of(heading), heading, speed * ahead_of(heading)};
}

Step Planner::step(int k, modeler::Side side, const Footprint& to) const {
  return {side, to, landing(k) - swing_, landing(k)};
}

double Planner::landing(int k) const { return std::round(lead_ * period_) + k * period_; }

Going::Going(const Scene& scene, const char* command, double pace)
    : scene_(scene),
      command_(command),
      body_(body_of(scene.model(), scene.actor.name, command)),
      period_(std::max(4.0, std::round(scene.film.rate / scene.arguments.number("pace", pace, {0.1, 10})))) {
  postures_.push_back(posture_of(scene));
  require_upright(scene, body_, postures_[0]);
}

// Refuses what cannot be walked whatever the joints allow, before a posture is sought.
void Going::require_possible(const Gait& gait, const char* remedy) const {
  scene_.last_after(double(postures_.size() - 1) + gait.end());
  const double reach = 2 * body_.leg_length();
  for (std::size_t i = 1; i < gait.steps.size(); ++i)
    if (const double step = glm::distance(gait.steps[i].to.place, gait.steps[i - 1].to.place); step > reach)
      throw Failure("would take a step of " + document::shown(step) + ", where two legs of " +
                        document::shown(body_.leg_length()) + " reach " + document::shown(reach) + " at most",
                    scene_.where(), remedy);
}

void Going::go(const Gait& gait, const char* remedy) {
  require_possible(gait, remedy);
  const Posture start = postures_.back();
  std::vector<Posture> more =
      postures_of(body_, start, gait, scene_.at + std::uint32_t(postures_.size()) - 1, command_, remedy);
  begin_at(*body_.model, start, gait.steps.front().off, more);
  postures_.insert(postures_.end(), more.begin() + 1, more.end());
}

void Going::turn(double by) {
  require_possible(turn_gait(body_, now(), by, kTurnBetweenFeet, period_), kTurnRemedy);
  for (double at_once = kTurnBetweenFeet;; at_once /= 2) try {
      return go(turn_gait(body_, now(), by, at_once, period_), kTurnRemedy);
    } catch (const Failure&) {
      if (at_once / 2 < kLeastAtOnce) throw;
    }
}

Motion Going::motion() const {
  return {keys_of(body_, body_.joints(), postures_, scene_.at), scene_.at + std::uint32_t(postures_.size()) - 1, ""};
}

void refuse_both(const Arguments& arguments, std::string_view one, std::string_view other) {
  if (arguments.has(one) && arguments.has(other))
    arguments.refuse(one, "stands beside " + std::string(other), "give one of them");
}

void refuse_contradictions(const Arguments& arguments, std::string_view count, std::string_view length) {
  refuse_both(arguments, "to", "distance");
  refuse_both(arguments, "to", "turn");
  if (!arguments.has(count) || !arguments.has(length)) return;
  refuse_both(arguments, count, "distance");
  refuse_both(arguments, count, "to");
}

Style style_of(const Arguments& arguments) {
  return {arguments.number("arm-swing", 1, {0, 3}), arguments.number("bounce", 1, {0, 3}),
          arguments.number("knee-lift", 1, {0, 3}), arguments.number("lean", 0, {-30, 45})};
}

modeler::Side first_side(const Arguments& arguments) {
  constexpr std::string_view sides[] = {"left", "right"};
  return kSides[arguments.choice("first", arguments.number("turn", 0, {-3600, 3600}) > 0 ? 0 : 1, sides)];
}

std::optional<Way> way_of(const Scene& scene, Going& going, double ordinary, double lost) {
  const Arguments& arguments = scene.arguments;
  refuse_contradictions(arguments, "steps", "step-length");
  const std::uint32_t asked = arguments.count("steps", 4, kMostSteps);
  std::optional<double> far = arguments.number("distance", {1e-6, document::kFarthest});
  const auto to = arguments.vector("to");
  if (to) {
    const double by = bearing(stand_of(going.now()), *to);
    if (std::abs(by) > kFirstStepTurn) going.turn(by);
    far = glm::distance(stand_of(going.now()).middle, glm::dvec2(to->x, to->y));
    if (*far < 0.05 * going.body().leg_length()) return std::nullopt;
  }
  const double step = arguments.number("step-length", ordinary, {1e-6, document::kFarthest});
  const std::uint32_t steps = far && !arguments.has("steps") ? steps_for(arguments, *far + lost * step, step) : asked;
  Path path{stand_of(going.now()), far ? *far : std::max(0.5, steps - lost) * step,
            arguments.number("turn", 0, {-3600, 3600})};
  if (to) path.start.heading = path.start.heading + bearing(path.start, *to);
  return Way{path, steps, arguments.has("turn") && !arguments.has("steps") && !arguments.has("step-length")};
}

void go_along(Going& going, const Way& way, const std::function<Gait(int steps)>& gait) {
  const char* const remedy = way.path.bend != 0 ? kBowRemedy : kStepRemedy;
  int steps = static_cast<int>(way.steps);
  for (int tries = way.may_shorten ? kBowTries : 1;; --tries, steps *= 2) try {
      return going.go(gait(steps), remedy);
    } catch (const Failure&) {
      if (tries == 1) throw;
    }
}

}  // namespace mars::motion
