#include "host/content/animator/motion/four_legs.h"

namespace mars::motion {
namespace {

// Of feet that stand on their toes: a lower leg hangs from hock or wrist as it swings forward.
constexpr CurvePoint kHindPitches[] = {{0, 40}, {0.2, 66}, {0.45, 58}, {0.7, 18}, {0.88, -14}, {1, -14}};
constexpr CurvePoint kForePitches[] = {{0, 40}, {0.22, 88}, {0.45, 92}, {0.68, 40}, {0.86, -8}, {1, -14}};
constexpr CurvePoint kHindRises[] = {{0, 0.06}, {0.2, 0.13}, {0.45, 0.17}, {0.7, 0.11}, {0.88, 0.03}, {1, 0}};
constexpr CurvePoint kForeRises[] = {{0, 0.06}, {0.2, 0.13}, {0.45, 0.20}, {0.7, 0.16}, {0.88, 0.04}, {1, 0}};
constexpr CurvePoint kHighHindRises[] = {{0, 0.06}, {0.2, 0.20}, {0.42, 0.32}, {0.66, 0.24}, {0.86, 0.06}, {1, 0}};
constexpr CurvePoint kHighForeRises[] = {{0, 0.06}, {0.2, 0.22}, {0.42, 0.38}, {0.66, 0.30}, {0.86, 0.08}, {1, 0}};
constexpr CurvePoint kBends[] = {{0, -40}, {0.18, 10}, {0.45, 34}, {0.7, 18}, {0.9, 10}, {1, 14}};

constexpr Tread tread_of(double stride, std::span<const CurvePoint> pitches, std::span<const CurvePoint> rises) {
  return {.stride = stride,
          .swing = 0,
          .flat = 0.45,
          .rise = 0.5,
          .strike = -14,
          .off = 40,
          .tip_off = 20,
          .clearance = 0.03,
          .pitches = {pitches, 140, 0},
          .rises = {rises, 0.5, 0},
          .bends = {kBends, 300, 0}};
}

constexpr FourLegGait kWalk{.hind = {0, 0.5},
                            .fore = {0.25, 0.75},
                            .duty = 0.64,
                            .stride = 1.25,
                            .pace = 1,
                            .hind_tread = tread_of(0.95, kHindPitches, kHindRises),
                            .fore_tread = tread_of(0.95, kForePitches, kForeRises),
                            .sink = 0.02,
                            .bounce = {0.008, 0.36, 2},
                            .rock = {0.8, 0.1, 2},
                            .flex = {0, 0, 1},
                            .nod = {4, 0.3, 2}};

constexpr FourLegGait kTrot{.hind = {0, 0.5},
                            .fore = {0.5, 0},
                            .duty = 0.42,
                            .stride = 1.9,
                            .pace = 1.6,
                            .hind_tread = tread_of(1.4, kHindPitches, kHighHindRises),
                            .fore_tread = tread_of(1.4, kForePitches, kHighForeRises),
                            .sink = 0.03,
                            .bounce = {0.022, 0.46, 2},
                            .rock = {0.5, 0.2, 2},
                            .flex = {0, 0, 1},
                            .nod = {1.5, 0.4, 2}};

constexpr FourLegGait kGallop{.hind = {0, 0.12},
                              .fore = {0.36, 0.5},
                              .duty = 0.27,
                              .stride = 3,
                              .pace = 2,
                              .hind_tread = tread_of(2.2, kHindPitches, kHighHindRises),
                              .fore_tread = tread_of(2.2, kForePitches, kHighForeRises),
                              .sink = 0.05,
                              .bounce = {0.035, 0.9, 1},
                              .rock = {5, 0.62, 1},
                              .flex = {7, 0.9, 1},
                              .nod = {7, 0.55, 1}};

}  // namespace

const FourLegGait& four_leg_walk() { return kWalk; }
const FourLegGait& four_leg_trot() { return kTrot; }
const FourLegGait& four_leg_gallop() { return kGallop; }

}  // namespace mars::motion
