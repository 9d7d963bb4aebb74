// A foot from step to step: how it stands, rolls off, swings and comes down.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "host/content/animator/motion/gaits/manner.h"
#include "host/content/animator/motion/body/stance.h"

namespace mars::motion {

// Where an ankle is when its foot stands flat.
struct Footprint {
  glm::dvec2 place;
  double heading;  // degrees
};

struct Step {
  modeler::Side side;
  Footprint to;
  double off;   // frames from the start: the foot leaves the floor
  double land;  // and is down again
};

// What a foot's way depends on beside its steps.
struct Footing {
  const Leg& leg;
  const Tread& tread;
  double period;  // frames, to which the tread's times are shares
  double floor;
  double lift;   // times the tread's rises
  double aside;  // how far to the left it is carried round the other
};

class Footwork {
 public:
  Footwork(const Footing& footing, const Footprint& start) : footing_(footing), start_(start) {}
  void add(const Step& step) { steps_.push_back(step); }  // in the order of landing
  Foot at(double time) const;

 private:
  double zeal(const Step& step, const Footprint& from) const;
  double off_pitch(const Step& step, const Footprint& from) const;
  double strike_pitch(const Step& step, const Footprint& from) const;
  Foot rolled(const Footprint& print, const glm::dvec3& pivot, double pitch, double bent) const;
  Foot standing(const Footprint& print, const Step* before, const Footprint& from, const Step* next, double time) const;
  Foot swinging(const Footprint& from, const Step& step, double time) const;
  double rise(const Step& step, const Footprint& from, const Foot& off, const Foot& land, double u) const;

  Footing footing_;
  Footprint start_;
  std::vector<Step> steps_;
};

}  // namespace mars::motion
