// Kinematic laws (thesis 3.2.1): where something is that has a velocity and an acceleration, and what a floor
// does to it. Closed forms from impact to impact: nothing is summed up step by step.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace mars::motion {

// Units of the film, seconds, degrees.
struct Launch {
  glm::dvec3 place{0, 0, 0};
  glm::dvec3 velocity{0, 0, 0};
  glm::dvec3 acceleration{0, 0, 0};
};

struct Floor {
  double height = 0;
  double restitution = 0.7;  // of the speed that an impact leaves, 0 to below 1
  double friction = 0.1;     // of the speed along the floor that an impact takes, 0 to 1
};

// From `time` on, until the next: place, velocity and acceleration there; and the turning, whose speed is
// counted in first turning speeds.
struct Arc {
  double time = 0;
  Launch launch;
  double spin = 1;    // speed of turning
  double brake = 0;   // what it loses a second
  double turned = 0;  // until then, as seconds of the first speed
};

class Flight {
 public:
  // Free, for ever.
  explicit Flight(const Launch& launch) : arcs_{{.launch = launch}} {}
  // Falls to the floor and bounces until a bounce is lower than `low`; then all bounces that would follow,
  // infinitely many in finite time, are left to their end, and it slides or lies. The acceleration is
  // downward.
  Flight(const Launch& launch, const Floor& floor, double low);

  glm::dvec3 place_at(double time) const;
  double turned_at(double time) const;  // seconds of the first turning speed
  std::span<const Arc> arcs() const { return arcs_; }
  double rest() const { return arcs_.back().time; }  // when nothing moves any more; of a free flight 0

 private:
  void slide(const Floor& floor);
  const Arc& arc_at(double time) const;

  std::vector<Arc> arcs_;
};

}  // namespace mars::motion
