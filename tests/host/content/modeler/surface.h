// Points and edges of bicubic patches, plainly, as oracles for tests of shapes.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <vector>

#include "node/wire/film.h"

namespace mars::modeler {

inline std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

inline std::array<double, 4> bernstein_slope(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

// In plain numbers, as tests evaluate millions of points; on sides most weights are 0.
inline glm::dvec3 blend(const wire::Patch& patch, const std::array<double, 4>& u, const std::array<double, 4>& v) {
  double sum[3] = {};
  const float* p = patch.points[0].data();
  for (const double row : v)
    for (const double column : u) {
      const double weight = column * row;
      if (weight != 0) {
        sum[0] += weight * p[0];
        sum[1] += weight * p[1];
        sum[2] += weight * p[2];
      }
      p += 3;
    }
  return {sum[0], sum[1], sum[2]};
}

inline glm::dvec3 point_of(const wire::Patch& patch, double u, double v) {
  return blend(patch, bernstein(u), bernstein(v));
}

// Along the outward normal, as long as the surface element.
inline glm::dvec3 normal_of(const wire::Patch& patch, double u, double v) {
  return glm::cross(blend(patch, bernstein_slope(u), bernstein(v)), blend(patch, bernstein(u), bernstein_slope(v)));
}

// By Gauss's theorem; negative if the normals point inward.
inline double volume_of(const std::vector<wire::Patch>& patches, int steps = 24) {
  double volume = 0;
  for (const wire::Patch& patch : patches)
    for (int j = 0; j < steps; ++j)
      for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps, v = (j + 0.5) / steps;
        volume += glm::dot(point_of(patch, u, v) - glm::dvec3(0.5), normal_of(patch, u, v)) / (3.0 * steps * steps);
      }
  return volume;
}

using Point = std::array<float, 3>;
using Edge = std::array<Point, 4>;

// The four sides, as they run round the patch with the outside in front.
inline std::array<Edge, 4> sides_of(const wire::Patch& patch) {
  constexpr int index[4][4] = {{0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}};
  std::array<Edge, 4> sides;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < 4; ++i) sides[side][i] = patch.points[index[side][i]];
  return sides;
}

inline bool collapsed(const Edge& edge) {
  return std::all_of(edge.begin(), edge.end(), [&](const Point& p) { return p == edge[0]; });
}

// How often each side that is no point runs one way and the other; equal, once each, on a closed surface.
struct EdgeUse {
  int forward = 0;
  int backward = 0;
};

inline std::map<Edge, EdgeUse> edge_uses(const std::vector<wire::Patch>& patches) {
  std::map<Edge, EdgeUse> uses;
  for (const wire::Patch& patch : patches)
    for (const Edge& side : sides_of(patch)) {
      if (collapsed(side)) continue;
      Edge reversed = side;
      std::reverse(reversed.begin(), reversed.end());
      side < reversed ? ++uses[side].forward : ++uses[reversed].backward;
    }
  return uses;
}

}  // namespace mars::modeler
