#include "host/content/animator/motion/gaits/running.h"

#include <cmath>

#include "host/content/animator/motion/gaits/advance.h"
#include "host/content/animator/motion/gaits/going.h"

namespace mars::motion {
namespace {

constexpr double kRunPace = 2.7;         // steps a second
constexpr double kRunLead = 0.85;        // of a period: the body leans forward before the first foot leaves
constexpr double kRunRest = 0.45;        // after the last landing it has stopped
constexpr double kRunSettle = 1;         // and stands upright
constexpr double kPeriodsToSpeed = 2.4;  // periods until it has its speed
constexpr double kPeriodsToStop = 3.2;   // that it needs to stop
constexpr double kLost = 0.7;            // of a step: by setting out and stopping
constexpr double kInLine = 0.55;         // of a walk's: feet are nearer to the middle
constexpr double kFootBehind = 0.1;  // of a leg: the foot stands behind the body in the middle of its time on the floor

Gait run_gait(const Body& body, const Stance& from, const Path& path, int steps, double period, modeler::Side first,
              const Style& style) {
  const Planner planner(body, running(), period, kRunLead);
  const double last = planner.landing(steps + 1), end = std::ceil(last + kRunSettle * period);
  const Advance advance(path.length, 0.2 * period, last + kRunRest * period, kPeriodsToSpeed * period,
                        kPeriodsToStop * period);
  const double stands = 2 * period - planner.swing();
  Gait gait{{}, {}, period, advance.speed() * period / body.leg_length(), style, &running()};
  modeler::Side side = first;
  for (int k = 1; k <= steps + 1; ++k, side = other(side)) {
    const bool stops = k >= steps;
    const double middle = planner.landing(k) + stands / 2;
    const double s = stops ? path.length : std::max(0.0, advance.at(middle) - kFootBehind * body.leg_length());
    const double apart = stops || body.planar() ? 1 : 1 - (1 - kInLine) * advance.speed_at(middle) / advance.speed();
    gait.steps.push_back(planner.step(k, side, planner.print(path.at(s), path.heading(s), side, apart)));
  }
  const glm::dvec2 off = glm::dvec2(from.pelvis) - planner.waypoint(0, path.at(0), path.heading(0), 0).place;
  for (int frame = 0; frame <= int(end); ++frame) {
    const double s = advance.at(frame);
    gait.way.push_back(planner.waypoint(frame, path.at(s), path.heading(s), advance.speed_at(frame)));
    gait.way.back().place += (1 - smooth(0, 2 * period, frame)) * off;
  }
  gait.way.front().heading = from.heading;
  return gait;
}

}  // namespace

Motion run(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  require_two_legs(scene.model(), scene.actor.name, "run");
  Going going(scene, "run", kRunPace);
  for (const modeler::Side side : kSides) needed(going.body(), modeler::Limb::knee, side, "run");
  const auto way = way_of(scene, going, running().tread.stride * going.body().leg_length(), kLost);
  if (!way) return going.motion();
  go_along(going, *way, [&](int steps) {
    return run_gait(going.body(), going.now(), way->path, steps, going.period(), first_side(arguments),
                    style_of(arguments));
  });
  return going.motion();
}

}  // namespace mars::motion
