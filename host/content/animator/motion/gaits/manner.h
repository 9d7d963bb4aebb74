// In what manner legs and trunk move in a gait: the numbers that tell a run from a walk.
#pragma once

#include <span>

#include "host/content/animator/motion/body/curve.h"

namespace mars::motion {

struct Course {
  std::span<const CurvePoint> points;  // over a swing, 0 to 1
  double first_slope, last_slope;

  double at(double u) const { return curve_through(points, first_slope, last_slope, u); }
};

// How feet move. Times are shares of a gait's period, lengths of a leg's length, angles degrees.
struct Tread {
  double stride;     // of an ordinary step
  double swing;      // for which a foot is off the floor
  double flat;       // from landing until the sole is down
  double rise;       // before it leaves, the heel rises
  double strike;     // pitch of the sole as it comes down
  double off;        // and as it leaves
  double tip_off;    // the same of feet without toes
  double clearance;  // of swinging feet over the floor, at least
  Course pitches;    // of the sole, for `strike` and `off`
  Course rises;      // of the ankle
  Course bends;      // of the toes, for `off`
};

// A mean, and how far it swings to either side with each stride.
struct Swing {
  double mean, by;
};

// How the trunk moves, for an ordinary stride. Lengths are shares of a leg's length, angles degrees, phases of
// the left foot's cycle.
struct Carriage {
  double sink;         // of the pelvis, on an average
  double bounce, low;  // how far up and down, and when it is lowest
  double surge, sway;  // forward and back, to the sides
  double roll, twist;  // of the pelvis
  double lean;         // of the pelvis
  double bend_of_spine, bend_of_chest, bend_of_neck, bend_of_head;
  double twist_of_spine, twist_of_chest;
  Swing shoulder, elbow;
};

struct Manner {
  Tread tread;
  Carriage carriage;
};

const Manner& walking();
const Manner& running();

}  // namespace mars::motion
