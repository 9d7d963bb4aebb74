#include "host/content/animator/motion/gaits/four_legs.h"

namespace mars::motion {
namespace {

// Of feet that stand on their toes: a lower leg hangs from hock or wrist as it swings forward.
constexpr CurvePoint kHindPitches[] = {{0, 40}, {0.2, 54}, {0.45, 48}, {0.7, 15}, {0.88, -14}, {1, -14}};
constexpr CurvePoint kForePitches[] = {{0, 40}, {0.22, 88}, {0.45, 92}, {0.68, 40}, {0.86, -8}, {1, -14}};
constexpr CurvePoint kLowHindPitches[] = {{0, 28}, {0.2, 42}, {0.45, 36}, {0.7, 10}, {0.88, -10}, {1, -10}};
constexpr CurvePoint kLowForePitches[] = {{0, 28}, {0.22, 52}, {0.45, 56}, {0.68, 26}, {0.86, -6}, {1, -10}};
constexpr CurvePoint kHindRises[] = {{0, 0.04}, {0.2, 0.08}, {0.45, 0.11}, {0.7, 0.08}, {0.88, 0.03}, {1, 0}};
constexpr CurvePoint kForeRises[] = {{0, 0.04}, {0.2, 0.09}, {0.45, 0.14}, {0.7, 0.12}, {0.88, 0.04}, {1, 0}};
constexpr CurvePoint kHighHindRises[] = {{0, 0.06}, {0.2, 0.15}, {0.42, 0.24}, {0.66, 0.19}, {0.86, 0.06}, {1, 0}};
constexpr CurvePoint kHighForeRises[] = {{0, 0.06}, {0.2, 0.22}, {0.42, 0.38}, {0.66, 0.30}, {0.86, 0.08}, {1, 0}};
constexpr CurvePoint kLowBends[] = {{0, -28}, {0.18, 8}, {0.45, 26}, {0.7, 14}, {0.9, 8}, {1, 10}};
constexpr CurvePoint kBends[] = {{0, -40}, {0.18, 10}, {0.45, 34}, {0.7, 18}, {0.9, 10}, {1, 14}};

constexpr Tread tread_of(double stride, double off, double strike, std::span<const CurvePoint> pitches,
                         std::span<const CurvePoint> rises, std::span<const CurvePoint> bends) {
  return {.stride = stride,
          .swing = 0,
          .flat = 0.45,
          .rise = 0.5,
          .strike = strike,
          .off = off,
          .tip_off = 20,
          .clearance = 0.03,
          .pitches = {pitches, 3.5 * off, 0},
          .rises = {rises, 0.4, 0},
          .bends = {bends, 7 * off, 0}};
}

constexpr FourLegGait kFourLegWalk{.hind = {0, 0.5},
                                   .fore = {0.25, 0.75},
                                   .duty = 0.64,
                                   .stride = 1,
                                   .pace = 1,
                                   .hind_tread = tread_of(0.7, 28, -10, kLowHindPitches, kHindRises, kLowBends),
                                   .fore_tread = tread_of(0.75, 28, -10, kLowForePitches, kForeRises, kLowBends),
                                   .sink = 0.02,
                                   .bounce = {0.008, 0.36, 2},
                                   .rock = {0.8, 0.1, 2},
                                   .flex = {0, 0, 1},
                                   .nod = {4, 0.3, 2}};

constexpr FourLegGait kFourLegTrot{.hind = {0, 0.5},
                                   .fore = {0.5, 0},
                                   .duty = 0.42,
                                   .stride = 1.65,
                                   .pace = 1.6,
                                   .hind_tread = tread_of(1.25, 40, -14, kHindPitches, kHighHindRises, kBends),
                                   .fore_tread = tread_of(1.25, 40, -14, kForePitches, kHighForeRises, kBends),
                                   .sink = 0.03,
                                   .bounce = {0.022, 0.46, 2},
                                   .rock = {0.5, 0.2, 2},
                                   .flex = {0, 0, 1},
                                   .nod = {1.5, 0.4, 2}};

constexpr FourLegGait kFourLegGallop{.hind = {0, 0.12},
                                     .fore = {0.36, 0.5},
                                     .duty = 0.27,
                                     .stride = 2.8,
                                     .pace = 2,
                                     .hind_tread = tread_of(2, 40, -14, kHindPitches, kHighHindRises, kBends),
                                     .fore_tread = tread_of(2, 40, -14, kForePitches, kHighForeRises, kBends),
                                     .sink = 0.05,
                                     .bounce = {0.035, 0.9, 1},
                                     .rock = {3, 0.62, 1},
                                     .flex = {7, 0.9, 1},
                                     .nod = {7, 0.55, 1}};

}  // namespace

const FourLegGait& four_leg_walk() { return kFourLegWalk; }
const FourLegGait& four_leg_trot() { return kFourLegTrot; }
const FourLegGait& four_leg_gallop() { return kFourLegGallop; }

}  // namespace mars::motion
