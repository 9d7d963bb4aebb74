// What gaits share: a figure that stands, a path on the floor, what a person asks of the way, and the postures
// that a figure has gone through so far.
#pragma once

#include <functional>
#include <optional>

#include "host/content/animator/motion/gaits/gait.h"
#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

inline constexpr std::uint32_t kMostSteps = 2000;
inline constexpr double kWalkLead = 0.35;   // of a period: weight goes to one foot before the first step
inline constexpr double kWalkSettle = 0.5;  // and to both after the last

// Refuses a figure that sits at the scene's frame.
void require_upright(const Scene& scene, const Body& body, const Posture& posture);

// Where a body stands, as steps see it.
struct Stand {
  glm::dvec2 middle;  // between its feet
  double heading;
};

Stand stand_of(const Stance& stance);
double bearing(const Stand& from, const glm::dvec3& to);  // degrees to turn to a place

// Circles are paths, too: `bend` degrees over the whole length.
struct Path {
  Stand start;
  double length;
  double bend;

  double heading(double s) const { return start.heading + bend * s / length; }
  glm::dvec2 at(double s) const;
};

// Where feet are put, and when. Landings are `lead` and then whole periods after the start.
class Planner {
 public:
  Planner(const Body& body, const Manner& manner, double period, double lead);

  Footprint print(const glm::dvec2& place, double heading, modeler::Side side, double apart = 1) const;
  Waypoint waypoint(double time, const glm::dvec2& middle, double heading, double speed) const;
  // The k-th landing, from 1; its swing before it.
  Step step(int k, modeler::Side side, const Footprint& to) const;
  // In whole frames, so that a film shows the foot as it comes down.
  double landing(int k) const;
  double swing() const { return swing_; }  // frames

 private:
  double period_, lead_, swing_;
  double forward_;  // of the ankles, from the pelvis
  double apart_;    // of an ankle from the middle
  double toe_out_;
};

// Postures so far, and the body that goes on from the last.
class Going {
 public:
  // `pace` in steps a second, where the script gives none.
  Going(const Scene& scene, const char* command, double pace);
  Going(const Scene&&, auto&&...) = delete;

  Stance now() const { return stance_of(body_, postures_.back()); }
  const Body& body() const { return body_; }
  double period() const { return period_; }

  void go(const Gait& gait, const char* remedy);
  void turn(double by);  // by steps that turn less, where limits want it
  Motion motion() const;

 private:
  void require_possible(const Gait& gait, const char* remedy) const;

  const Scene& scene_;
  const char* command_;
  Body body_;
  double period_;
  std::vector<Posture> postures_;
};

// Refuses two parameters that say the same.
void refuse_both(const Arguments& arguments, std::string_view one, std::string_view other);

// Refuses ways that are said twice: `count` and `length` are "steps" and "step-length".
void refuse_contradictions(const Arguments& arguments, std::string_view count, std::string_view length);

// How a person says which way to go: steps, distance, to, turn, step-length.
struct Way {
  Path path;
  std::uint32_t steps;
  bool may_shorten;  // nobody has said how many or how long the steps are of a bow
};

// Turns the figure first where `to` asks for it; nothing if it is there. `ordinary` is a step's length; setting out and
// stopping cost that number of steps' lengths.
std::optional<Way> way_of(const Scene& scene, Going& going, double ordinary, double lost = 0);

// Goes by `gait(steps)`: in twice as many shorter steps, where limits want it and the way allows it.
void go_along(Going& going, const Way& way, const std::function<Gait(int steps)>& gait);

Style style_of(const Arguments& arguments);
modeler::Side first_side(const Arguments& arguments);

}  // namespace mars::motion
