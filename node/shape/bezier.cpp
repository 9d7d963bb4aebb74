#include "node/shape/bezier.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace mars::shape {
namespace {

// All rates' tables in one block: for each rate, seven arrays of rate + 1.
class BasisTables {
 public:
  BasisTables() : numbers_(static_cast<std::size_t>(7 * (kMaxRate + 1) * (kMaxRate + 2) / 2 + simd::kVectorSlack)) {
    float* next = numbers_.data();
    for (int rate = 1; rate <= kMaxRate; ++rate) next = fill(rate, next);
  }

  const Basis& at(int rate) const { return bases_[static_cast<std::size_t>(rate)]; }

 private:
  float* fill(int rate, float* next) {
    Basis& basis = bases_[static_cast<std::size_t>(rate)];
    basis.rate = rate;
    float* row[7];
    for (float*& r : row) r = std::exchange(next, next + rate + 1);
    std::copy(row, row + 4, basis.cubic);
    std::copy(row + 4, row + 7, basis.quadratic);
    for (int i = 0; i <= rate; ++i) {
      const double t = static_cast<double>(i) / rate, s = 1.0 - t;
      const double value[7] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t, s * s, 2 * s * t, t * t};
      for (int k = 0; k < 7; ++k) row[k][i] = static_cast<float>(value[k]);
    }
    return next;
  }

  std::vector<float> numbers_;
  std::array<Basis, kMaxRate + 1> bases_{};
};

float square_length(float x, float y, float z) { return x * x + y * y + z * z; }

// |a x b|^2
float square_cross(const float* a, const float* b) {
  return square_length(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

// A bound from below for the distance from the eye to the hull of `count` points.
float distance(const float (*p)[3], int count) {
  float middle[3] = {0, 0, 0}, radius = 0;
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) middle[axis] += p[i][axis];
  for (float& m : middle) m /= static_cast<float>(count);
  for (int i = 0; i < count; ++i)
    radius = std::max(radius, square_length(p[i][0] - middle[0], p[i][1] - middle[1], p[i][2] - middle[2]));
  return std::sqrt(square_length(middle[0], middle[1], middle[2])) - std::sqrt(radius);
}

// Pixels a unit length shows at distance 1 in the direction in which they are the denser.
float finest(const Projection& projection) { return projection.scale * std::max(projection.squeeze, 1.0f); }

// Pixels a unit length shows at most anywhere in the hull of `count` points: what is seen lies no nearer than
// the nearest point, nor than its distance from the eye allows within the picture's corners, where lengths
// that point away from the middle show longest.
float magnification(const float (*p)[3], int count, const Projection& projection) {
  if (projection.parallel) return finest(projection);
  float nearest = -p[0][2];
  for (int i = 1; i < count; ++i) nearest = std::min(nearest, -p[i][2]);
  const float depth = std::max({nearest, projection.near, projection.corner * distance(p, count)});
  return finest(projection) / (projection.corner * depth);
}

int whole_steps(float rate) {
  if (!(rate < kMaxRate)) return kMaxRate;
  const int whole = static_cast<int>(rate);
  return std::max(1, static_cast<float>(whole) < rate ? whole + 1 : whole);
}

// Steps for a second derivative of `bound` pixels: ceil(sqrt(bound / (8 tolerance))).
int steps(float bound, float tolerance) { return whole_steps(std::sqrt(bound / (8 * tolerance))); }

// Places near the patch's borders and between.
CurvatureWeights curvature_weights() {
  constexpr double kPlaces[] = {1.0 / 16, 3.0 / 8, 5.0 / 8, 15.0 / 16};
  // Bernstein polynomials and their first and second derivatives.
  const auto polynomials = [](double t) {
    const double s = 1 - t;
    return std::array<std::array<double, 4>, 3>{{{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
                                                 {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t},
                                                 {6 * s, 6 * t - 12 * s, 6 * s - 12 * t, 6 * t}}};
  };
  constexpr int kOrder[CurvatureWeights::kKinds][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  CurvatureWeights out;
  for (std::size_t place = 0; place < 16; ++place) {
    const auto along_u = polynomials(kPlaces[place % 4]), along_v = polynomials(kPlaces[place / 4]);
    for (std::size_t kind = 0; kind < CurvatureWeights::kKinds; ++kind)
      for (std::size_t i = 0; i < 16; ++i)
        out.weight[kind][i][place] = static_cast<float>(along_u[static_cast<std::size_t>(kOrder[kind][0])][i % 4] *
                                                        along_v[static_cast<std::size_t>(kOrder[kind][1])][i / 4]);
  }
  return out;
}

bool is_point(const Curve& curve) {
  const auto& p = curve.point;
  return std::all_of(p + 1, p + 4, [&](const auto& other) { return std::equal(other, other + 3, p[0]); });
}

bool comes_after(const Curve& curve) {
  const auto& p = curve.point;
  for (const auto& [a, b] : {std::pair{0, 3}, std::pair{1, 2}})
    for (int axis = 0; axis < 3; ++axis)
      if (p[a][axis] != p[b][axis]) return p[a][axis] > p[b][axis];
  return false;
}

}  // namespace

EyeMatrix eye_matrix(const wire::Matrix& world_to_eye, const wire::Matrix& to_world) {
  EyeMatrix out;
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& e = world_to_eye.m[r];
    for (std::size_t c = 0; c < 4; ++c) {
      const auto& w = to_world.m;
      out.m[r][c] = static_cast<float>(e[0] * w[0][c] + e[1] * w[1][c] + e[2] * w[2][c] + (c == 3 ? e[3] : 0.0));
    }
  }
  return out;
}

bool mirrors(const EyeMatrix& matrix) {
  const auto& m = matrix.m;
  const auto minor = [&](int a, int b) {
    return static_cast<double>(m[1][a]) * m[2][b] - static_cast<double>(m[1][b]) * m[2][a];
  };
  return m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1) < 0;
}

void to_eye(const EyeMatrix& matrix, const std::array<float, 3>& p, float (&out)[3]) {
  for (int r = 0; r < 3; ++r) {
    const float* m = matrix.m[r];
    out[r] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
  }
}

EyePatch to_eye(const EyeMatrix& matrix, const wire::Patch& patch) {
  EyePatch out;
  for (std::size_t i = 0; i < 16; ++i) to_eye(matrix, patch.points[i], out.point[i]);
  return out;
}

const Basis& basis(int rate) {
  static const BasisTables tables;
  return tables.at(rate);
}

Edge edge(const EyePatch& patch, Side side) {
  constexpr int first[] = {0, 3, 12, 0};
  constexpr int stride[] = {1, 4, 1, 4};
  const auto s = static_cast<std::size_t>(side);
  Edge out{};
  for (int i = 0; i < 4; ++i) std::copy_n(patch.point[first[s] + i * stride[s]], 3, out.curve.point[i]);
  out.reversed = comes_after(out.curve);
  if (out.reversed) {
    std::swap(out.curve.point[0], out.curve.point[3]);
    std::swap(out.curve.point[1], out.curve.point[2]);
  }
  return out;
}

// One sample a pixel cannot show what several do: outlines to a fraction of a pixel, and rims thinner than one.
Tolerances tolerances_of(std::uint32_t samples) {
  if (samples == 1) return {.outline = 3.0f / 16, .turn = 0.2f, .least_step = 4};
  return {.outline = 3.0f / 128, .turn = 0.1f, .least_step = 0.35f};
}

// Second differences of the control points, times six, bound the second derivative. Seen from the eye, what of it
// lies along a ray does not show; across, at depth w, a length shows at most scale |p| / w^2 times, along the ray
// through p. Both bounds hold for all rays to the curve if they do for those to its control points. Parallel rays are
// one.
int edge_rate(const Curve& curve, const Projection& projection, float tolerance) {
  const auto& p = curve.point;
  float bend = 0, across = 0, nearest = -p[0][2];
  for (int i = 1; i < 4; ++i) nearest = std::min(nearest, -p[i][2]);
  for (int k = 0; k < 2; ++k) {
    float second[3];
    for (int axis = 0; axis < 3; ++axis) second[axis] = p[k][axis] - 2 * p[k + 1][axis] + p[k + 2][axis];
    bend = std::max(bend, square_length(second[0], second[1], second[2]));
    if (projection.parallel)
      across = std::max(across, second[0] * second[0] + second[1] * second[1]);
    else
      for (const auto& ray : p) across = std::max(across, square_cross(second, ray));
  }
  const float depth = projection.parallel ? 1 : std::max(nearest, projection.near);
  return steps(6 * std::min(std::sqrt(bend) * magnification(p, 4, projection),
                            std::sqrt(across) * finest(projection) / (depth * depth)),
               tolerance);
}

Rates rates(const ShapeKernels& kernels, const EyePatch& patch, const Projection& projection, const Dicing& dicing) {
  if (const int n = dicing.fixed_rate; n > 0) return {n, n, {n, n, n, n}};
  static const CurvatureWeights weights = curvature_weights();
  const Fineness inside = kernels.estimate_curvature(weights, patch.point, projection, dicing.tolerances);
  Rates out{
      std::min(whole_steps(inside.u), dicing.most_inside), std::min(whole_steps(inside.v), dicing.most_inside), {}};
  for (const Side side : {Side::bottom, Side::right, Side::top, Side::left}) {
    const Curve curve = edge(patch, side).curve;
    int& rate = out.side[static_cast<int>(side)];
    if (!is_point(curve)) {
      rate = edge_rate(curve, projection, dicing.tolerances.outline);
    } else if (side == Side::bottom || side == Side::top) {
      rate = out.u;
      out.v = std::max(out.v, out.u);
    } else {
      rate = out.v;
      out.u = std::max(out.u, out.v);
    }
  }
  return out;
}

bool unseen(const EyePatch& patch, const Projection& projection, float width, float height) {
  return unseen(patch.point, 16, projection, width, height);
}

bool unseen(const float (*points)[3], int count, const Projection& projection, float width, float height) {
  // Half-spaces of places that cannot be drawn: nearer, farther, left, right, above, below, with a pixel's margin.
  bool all[6] = {true, true, true, true, true, true};
  const auto [first_x, first_y] = projection.origin;
  const float left = projection.center[0] + 1 - static_cast<float>(first_x);
  const float right = width + 1 - projection.center[0] + static_cast<float>(first_x);
  const float above = projection.center[1] + 1 - static_cast<float>(first_y);
  const float below = height + 1 - projection.center[1] + static_cast<float>(first_y);
  for (int i = 0; i < count; ++i) {
    const float* p = points[i];
    const float w = -p[2], x = projection.scale * projection.squeeze * p[0], y = -projection.scale * p[1];
    const float spread = projection.parallel ? 1 : w;
    all[0] &= w < projection.near;
    all[1] &= w > projection.far;
    all[2] &= x < -left * spread;
    all[3] &= x > right * spread;
    all[4] &= y < -above * spread;
    all[5] &= y > below * spread;
  }
  return std::any_of(all, all + 6, [](bool outside) { return outside; });
}

}  // namespace mars::shape
