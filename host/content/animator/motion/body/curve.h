// Smooth curves: through points by Hermite's cubics, and from 0 to 1.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace mars::motion {

using CurvePoint = std::array<double, 2>;  // x, y

// Between (x0, y0) and (x1, y1) with the slopes m0 and m1.
inline double hermite(const CurvePoint& p0, const CurvePoint& p1, double m0, double m1, double x) {
  const double h = p1[0] - p0[0], t = (x - p0[0]) / h;
  return ((2 * t - 3) * t * t + 1) * p0[1] + ((t - 2) * t + 1) * t * h * m0 + (3 - 2 * t) * t * t * p1[1] +
         (t - 1) * t * t * h * m1;
}

// Through all points, two at least, x ascending; inner slopes are those from neighbour to neighbour.
inline double curve_through(std::span<const CurvePoint> points, double first_slope, double last_slope, double x) {
  const auto slope = [&](std::size_t i) {
    if (i == 0) return first_slope;
    if (i + 1 == points.size()) return last_slope;
    return (points[i + 1][1] - points[i - 1][1]) / (points[i + 1][0] - points[i - 1][0]);
  };
  const auto ends_before = [](const CurvePoint& point, double at) { return point[0] < at; };
  const auto end = std::lower_bound(points.begin() + 1, points.end() - 1, x, ends_before);
  const auto i = static_cast<std::size_t>(end - points.begin()) - 1;
  return hermite(points[i], points[i + 1], slope(i), slope(i + 1), x);
}

// From 0 to 1 as x goes from `from` to `to`, starting and ending slowly.
inline double smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return (3 - 2 * t) * t * t;
}

// The lowest curve over all values that changes no faster than a moving mean over `reach` values to each
// side.
inline std::vector<double> smooth_cover(const std::vector<double>& values, int reach) {
  const auto over = [&](const std::vector<double>& from, auto take) {
    std::vector<double> result(from.size());
    for (int i = 0; i < int(from.size()); ++i) {
      const int first = std::max(0, i - reach), last = std::min(int(from.size()) - 1, i + reach);
      result[i] = take(from.begin() + first, from.begin() + last + 1);
    }
    return result;
  };
  const auto highest = over(values, [](auto a, auto b) { return *std::max_element(a, b); });
  return over(highest, [](auto a, auto b) {
    double sum = 0;
    for (auto i = a; i != b; ++i) sum += *i;
    return sum / double(b - a);
  });
}

}  // namespace mars::motion
