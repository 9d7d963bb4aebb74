// How a value goes from a key to the next. Timing: how much of the way is done when a part of the time is, a cubic
// Bezier curve from (0, 0) to (1, 1) with the control points (x1, y1) and (x2, y2), x in time, as in CSS. Or a spline
// through the keys, whose curve is in channel.h. Or not at all: the value holds, and jumps at the next key.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace mars::animator {

struct Ease {
  double x1 = 0, y1 = 0, x2 = 1, y2 = 1;  // x1 and x2 in 0..1, so that time runs forward; y in -10..10
  bool spline = false;                    // time is then even
  bool hold = false;

  bool operator==(const Ease&) const = default;
};

inline constexpr Ease kLinear{0, 0, 1, 1};
inline constexpr Ease kIn{0.42, 0, 1, 1};       // starts slowly
inline constexpr Ease kOut{0, 0, 0.58, 1};      // ends slowly
inline constexpr Ease kBoth{0.42, 0, 0.58, 1};  // starts and ends slowly
inline constexpr Ease kSpline{0, 0, 1, 1, true};
inline constexpr Ease kHold{0, 0, 1, 1, false, true};

// As files and people name them.
inline constexpr std::array<std::pair<std::string_view, Ease>, 6> kNamedEases{
    {{"linear", kLinear}, {"in", kIn}, {"out", kOut}, {"both", kBoth}, {"spline", kSpline}, {"hold", kHold}}};

// `time` in 0..1; exactly 0 and 1 at the ends, exactly `time` where the curve is straight.
double eased(const Ease& ease, double time);

// The least and the greatest part of the way that the curve takes: beyond 0..1 if it swings.
struct Swing {
  double lowest = 0;
  double highest = 1;
};
Swing swing_of(const Ease& ease);

// The two halves of the curve, before and after `time` (inside 0..1), each as an ease of its own; none if
// either would need numbers that a film file does not take.
std::optional<std::pair<Ease, Ease>> split(const Ease& ease, double time);

// An ease that first swings back by `anticipation` parts of the way and at last beyond by `overshoot`, each 0..1.
Ease swinging(double anticipation, double overshoot);

}  // namespace mars::animator
