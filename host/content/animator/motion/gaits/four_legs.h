// Gaits of four legs: which foot is down when, how the trunk goes along, and the postures that come of it.
#pragma once

#include "host/content/animator/motion/gaits/going.h"

namespace mars::motion {

// Of the trunk, once or twice a stride: so far to either side, highest at that phase of the left hind foot's
// cycle.
struct Beat {
  double by, highest;
  int times;
};

struct FourLegGait {
  std::array<double, 2> hind, fore;  // phases at which the left and the right foot land, shares of a stride
  double duty;                       // share of a stride for which a foot is on the floor
  double stride;                     // of the hips' height
  double pace;                       // strides a second
  Tread hind_tread, fore_tread;      // times are shares of a foot's time on the floor, `stride` of half a stride
  double sink;                       // of the pelvis, of the hips' height, on an average
  Beat bounce;                       // of the pelvis, of the hips' height
  Beat rock;                         // degrees that the trunk dips
  Beat flex;                         // degrees that the back bends
  Beat nod;                          // degrees of the neck
};

const FourLegGait& four_leg_walk();
const FourLegGait& four_leg_trot();
const FourLegGait& four_leg_gallop();

// What a person asks of a gait.
struct FourLegStyle {
  double bounce = 1, lift = 1;  // times an ordinary one's
};

// How far the trunk turns or goes, in a number of strides.
struct Errand {
  Path path;
  double turn;  // degrees on the spot; then the path is not gone
  int strides;
};

// The postures of a figure that starts from `start` and stands in the end.
std::vector<Posture> four_leg_postures(const Body& body, const Posture& start, const FourLegGait& gait,
                                       const FourLegStyle& style, const Errand& errand, double period,
                                       std::uint32_t first_frame, const std::string& doing);

// Strides' lengths that setting out and stopping cost; negative: what they add.
double lost_strides(const FourLegGait& gait);

// Frames that it takes.
double four_leg_frames(const FourLegGait& gait, int strides, double period);

}  // namespace mars::motion
