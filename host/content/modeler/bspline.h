// B-spline surfaces of degree 1 to 3, and the bicubic Bezier patches that are the same surfaces. Conversion
// is exact but for rounding: Bezier points are blossoms of the spline (Ramshaw 1987), which take nothing but
// weighted means, so they stay within the hull of the control points, and lower degrees are raised. Each
// point of the net is computed once and shared by the patches that meet in it, across a periodic seam too.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/modeler/control_net.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

inline constexpr int kMostDegree = 3;

enum class Ends { clamped, open, periodic };

// One direction of a surface, over n control points. `knots` never descend. Control point i works from knot i
// to knot i + degree + 1.
// Not periodic: n + degree + 1 knots, the surface lies from knot `degree` to knot n, which is greater;
// within, a knot stands at most `degree` times. Periodic: n + 1 knots, the last is the first come round
// again, with point 0 following point n - 1; a knot stands at most `degree` times, first and last counting as
// one. n is at least degree + 1.
struct SplineDirection {
  int degree = kMostDegree;
  bool periodic = false;
  std::vector<double> knots;
};

// Knots 1 apart; clamped: the first and the last stand degree + 1 times, so that the surface begins and ends
// in the outermost control points.
SplineDirection uniform_direction(Ends ends, int degree, std::size_t points);

// Rows along v of points along u, all of one length.
using PointGrid = std::vector<std::vector<glm::dvec3>>;

// Patches with their points as in wire::Patch.
using Net = std::vector<std::array<glm::dvec3, 16>>;

// One patch for each pair of knot spans, u running first. Neighbours share their four points.
Net bezier_patches(const PointGrid& points, const SplineDirection& u, const SplineDirection& v);

// The same patches as means of `rows` of `columns` control points, which are numbered row by row.
MeanPatches bezier_means(std::size_t columns, std::size_t rows, const SplineDirection& u, const SplineDirection& v);

// As nodes hold them: a coordinate within 0..1 moves by at most 2^-25.
std::vector<wire::Patch> rounded(const Net& net);

}  // namespace mars::modeler
