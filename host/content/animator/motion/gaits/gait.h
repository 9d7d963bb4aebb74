// Steps: from a plan of footprints and times to a stance at every moment. Walking, turning and running are plans
// of steps.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "host/content/animator/motion/gaits/footwork.h"

namespace mars::motion {

// Through which the pelvis goes.
struct Waypoint {
  double time;  // frames from the start
  glm::dvec2 place;
  double heading;       // degrees, not wrapped: more than a turn is more than a turn
  glm::dvec2 velocity;  // per frame
};

struct Style {
  double arm_swing = 1;  // shares of an ordinary walk's
  double bounce = 1;
  double knee_lift = 1;
  double lean = 0;  // degrees, forward, beyond an ordinary walk's
};

struct Gait {
  std::vector<Step> steps;    // in the order of landing
  std::vector<Waypoint> way;  // from 0 to the end
  double period;              // frames from landing to landing
  double stride;              // a step's length over the leg's, for how much the body swings
  Style style;
  const Manner* manner = &walking();

  double end() const { return way.back().time; }
};

// Legs of one piece swing from the hips. The pelvis is where both reach the floor when both stand, and so
// high as the one that stands lets it; the other is lifted by the pelvis' roll, or carried round the outside
// where hips are narrow, and brushes the floor once where hips do not turn aside. The postures of frames 0 to
// the gait's end, from `start` on. `doing` and `remedy` are for failures.
std::vector<Posture> postures_of(const Body& body, const Posture& start, const Gait& gait, std::uint32_t first_frame,
                                 const std::string& doing, const std::string& remedy);

// How a body stands at ease: arms hanging, trunk upright.
std::map<std::size_t, glm::dmat3> at_ease(const Body& body);

}  // namespace mars::motion
