#include "host/content/animator/motion/gaits/steps.h"

#include <cmath>

#include "host/content/animator/motion/gaits/going.h"
#include "host/content/animator/motion/gaits/striding.h"

namespace mars::motion {
namespace {

constexpr double kStepPace = 2;            // steps a second
constexpr double kPelvisBehind = 0.526;    // of a step: the pelvis is behind the foot that lands
constexpr double kFirstBehind = 0.44;      // the first foot, from standing
constexpr double kLeastTurnOfSteps = 0.2;  // degrees

Gait walk_gait(const Body& body, const Stance& from, const Path& path, int steps, double period, modeler::Side first,
               const Style& style) {
  const Planner planner(body, walking(), period, kWalkLead);
  const double length = path.length / steps, speed = length / period;
  const double behind = body.stiff() ? 0.5 : kPelvisBehind;
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
      planner.waypoint(std::ceil(planner.landing(steps + 1) + kWalkSettle * period), path.at(path.length), end, 0));
  return gait;
}

}  // namespace

Motion walk(const Scene& scene) {
  if (has_four_legs(scene.model())) return walk_on_four(scene);
  Going going(scene, "walk", kStepPace);
  const auto way = way_of(scene, going, walking().tread.stride * going.body().leg_length());
  if (!way) return going.motion();
  go_along(going, *way, [&](int steps) {
    return walk_gait(going.body(), going.now(), way->path, steps, going.period(), first_side(scene.arguments),
                     style_of(scene.arguments));
  });
  return going.motion();
}

Motion turn(const Scene& scene) {
  if (has_four_legs(scene.model())) return turn_on_four(scene);
  refuse_both(scene.arguments, "by", "to");
  Going going(scene, "turn", kStepPace);
  const auto to = scene.arguments.vector("to");
  const double by = to ? bearing(stand_of(going.now()), *to) : scene.arguments.number("by", 90, {-3600, 3600});
  if (std::abs(by) > kLeastTurnOfSteps) going.turn(by);
  return going.motion();
}

}  // namespace mars::motion
