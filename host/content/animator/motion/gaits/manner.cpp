#include "host/content/animator/motion/gaits/manner.h"

namespace mars::motion {
namespace {

// An ordinary man's walk.
constexpr CurvePoint kWalkPitches[] = {{0, 50}, {0.184, 63}, {0.424, 38}, {0.688, 0}, {0.88, -19}, {1, -20}};
constexpr CurvePoint kWalkRises[] = {{0, 0.070}, {0.1, 0.112}, {0.28, 0.136}, {0.52, 0.093}, {0.76, 0.031}, {1, 0.017}};
constexpr CurvePoint kWalkBends[] = {{0, -50}, {0.2, -46}, {0.328, -18}, {0.472, -3}, {0.664, 0}, {1, 0}};
constexpr Manner kWalking{.tread = {.stride = 0.616,
                                    .swing = 5.0 / 6,
                                    .flat = 1.0 / 6,
                                    .rise = 0.5,
                                    .strike = -20,
                                    .off = 50,
                                    .tip_off = 24,
                                    .clearance = 0.012,
                                    .pitches = {kWalkPitches, 60, 0},
                                    .rises = {kWalkRises, 0.6, -0.1},
                                    .bends = {kWalkBends, 0, 0}},
                          .carriage = {.sink = 0.0216,
                                       .bounce = 0.0124,
                                       .low = 0.056,
                                       .surge = 0.013,
                                       .sway = 0.0216,
                                       .roll = 2.5,
                                       .twist = 5,
                                       .lean = 3,
                                       .bend_of_spine = 0.5,
                                       .bend_of_chest = 1.5,
                                       .bend_of_neck = 1,
                                       .bend_of_head = -4,
                                       .twist_of_spine = 4.5,
                                       .twist_of_chest = 5.5,
                                       .shoulder = {-3, 21},
                                       .elbow = {-14, 15}}};

// An ordinary man's run at three metres a second: the heel of the swinging leg comes up behind.
constexpr CurvePoint kRunPitches[] = {{0, 50}, {0.2, 88}, {0.42, 84}, {0.62, 44}, {0.82, 6}, {0.93, -5}, {1, -8}};
constexpr CurvePoint kRunRises[] = {{0, 0.07},   {0.18, 0.27}, {0.36, 0.42}, {0.52, 0.40},
                                    {0.7, 0.24}, {0.86, 0.10}, {1, 0.01}};
constexpr CurvePoint kRunBends[] = {{0, -50}, {0.12, -30}, {0.25, -6}, {0.4, 0}, {0.7, 0}, {1, 0}};
constexpr Manner kRunning{.tread = {.stride = 1.15,
                                    .swing = 1.35,
                                    .flat = 0.1,
                                    .rise = 0.42,
                                    .strike = -8,
                                    .off = 50,
                                    .tip_off = 24,
                                    .clearance = 0.03,
                                    .pitches = {kRunPitches, 160, -20},
                                    .rises = {kRunRises, 1.2, -0.5},
                                    .bends = {kRunBends, 0, 0}},
                          .carriage = {.sink = 0.04,
                                       .bounce = 0.032,
                                       .low = 0.165,
                                       .surge = 0,
                                       .sway = 0.006,
                                       .roll = 3,
                                       .twist = 8,
                                       .lean = 7,
                                       .bend_of_spine = 3,
                                       .bend_of_chest = 4,
                                       .bend_of_neck = -3,
                                       .bend_of_head = -9,
                                       .twist_of_spine = 7,
                                       .twist_of_chest = 8,
                                       .shoulder = {6, 36},
                                       .elbow = {-78, 16}}};

}  // namespace

const Manner& walking() { return kWalking; }
const Manner& running() { return kRunning; }

}  // namespace mars::motion
