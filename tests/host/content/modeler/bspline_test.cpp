// Bezier patches made of B-spline surfaces, against the basis functions as Cox and de Boor define them.
#include "host/content/modeler/bspline.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "tests/host/content/modeler/surface.h"

namespace mars::modeler {
namespace {

// Knots and control points as a plain, long list: where the direction is periodic, a turn before and one
// behind its own.
struct Unrolled {
  std::vector<double> knots;
  std::vector<std::size_t> points;  // which control point the basis function from knots[i] on belongs to
  double from;
  double to;
};

Unrolled unroll(const SplineDirection& direction, std::size_t points) {
  Unrolled plain{direction.knots, {}, 0, 0};
  for (std::size_t i = 0; i < points; ++i) plain.points.push_back(i);
  plain.from = direction.periodic ? plain.knots[0] : plain.knots[static_cast<std::size_t>(direction.degree)];
  plain.to = plain.knots[points];
  if (!direction.periodic) return plain;
  const std::vector<double> turn(plain.knots.begin(), plain.knots.end() - 1);
  std::vector<double> knots;
  std::vector<std::size_t> owners;
  for (const int round : {-1, 0, 1})
    for (std::size_t i = 0; i < points; ++i) {
      knots.push_back(turn[i] + round * (plain.to - plain.from));
      owners.push_back(i);
    }
  return {knots, owners, plain.from, plain.to};
}

double basis(const std::vector<double>& knots, std::size_t i, int degree, double t) {
  if (degree == 0) return knots[i] <= t && t < knots[i + 1] ? 1 : 0;
  const auto p = static_cast<std::size_t>(degree);
  double sum = 0;
  if (knots[i + p] > knots[i]) sum += (t - knots[i]) / (knots[i + p] - knots[i]) * basis(knots, i, degree - 1, t);
  if (knots[i + p + 1] > knots[i + 1])
    sum += (knots[i + p + 1] - t) / (knots[i + p + 1] - knots[i + 1]) * basis(knots, i + 1, degree - 1, t);
  return sum;
}

// Of each control point, at t within [from, to).
std::vector<double> weights_at(const SplineDirection& direction, std::size_t points, double t) {
  const Unrolled plain = unroll(direction, points);
  std::vector<double> weights(points);
  for (std::size_t i = 0; i + static_cast<std::size_t>(direction.degree) + 1 < plain.knots.size(); ++i)
    weights[plain.points[i]] += basis(plain.knots, i, direction.degree, t);
  return weights;
}

// The spans of a direction, in order: [first, second).
std::vector<std::pair<double, double>> spans_of(const SplineDirection& direction, std::size_t points) {
  std::vector<std::pair<double, double>> spans;
  const std::size_t first = direction.periodic ? 0 : static_cast<std::size_t>(direction.degree);
  for (std::size_t i = first; i < points; ++i)
    if (direction.knots[i] < direction.knots[i + 1]) spans.emplace_back(direction.knots[i], direction.knots[i + 1]);
  return spans;
}

glm::dvec3 patch_point(const std::array<glm::dvec3, 16>& patch, double u, double v) {
  glm::dvec3 sum(0, 0, 0);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) sum += bernstein(u)[i] * bernstein(v)[j] * patch[4 * j + i];
  return sum;
}

glm::dvec3 mean_of(const PointGrid& points, const std::vector<double>& u, const std::vector<double>& v) {
  glm::dvec3 sum(0, 0, 0);
  for (std::size_t j = 0; j < v.size(); ++j)
    for (std::size_t i = 0; i < u.size(); ++i) sum += u[i] * v[j] * points[j][i];
  return sum;
}

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

  double real() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  int whole(int lowest, int highest) { return std::uniform_int_distribution<int>(lowest, highest)(random_); }

  PointGrid points(std::size_t columns, std::size_t rows) {
    PointGrid grid(rows, std::vector<glm::dvec3>(columns));
    for (auto& row : grid)
      for (glm::dvec3& point : row) point = {real(), real(), real()};
    return grid;
  }

  // Knots of all kinds: single ones and ones up to `degree` times, ends clamped, half clamped or open.
  SplineDirection direction(std::size_t& points) {
    SplineDirection found = any_direction(points);
    while (spans_of(found, points).empty()) found = any_direction(points);
    return found;
  }

 private:
  SplineDirection any_direction(std::size_t& points) {
    SplineDirection direction{whole(1, 3), whole(0, 1) == 1, {}};
    points = static_cast<std::size_t>(direction.degree + whole(1, 7));
    const std::size_t count = points + (direction.periodic ? 1 : static_cast<std::size_t>(direction.degree) + 1);
    double at = whole(-5, 5);
    while (direction.knots.size() < count) {
      const int times = direction.periodic && direction.knots.empty() ? 1 : whole(1, direction.degree);
      for (int i = 0; i < times && direction.knots.size() < count; ++i) direction.knots.push_back(at);
      at += whole(0, 1) ? real() + 0.01 : 1;
    }
    if (direction.periodic) direction.knots.back() = at;
    if (!direction.periodic && whole(0, 1))
      std::fill_n(direction.knots.begin(), direction.degree + 1,
                  direction.knots[static_cast<std::size_t>(direction.degree)]);
    return direction;
  }

  std::mt19937 random_;
};

void expect_same_surface(const PointGrid& points, const SplineDirection& u, const SplineDirection& v, Dice& dice) {
  const auto across = spans_of(u, points[0].size()), along = spans_of(v, points.size());
  const Net net = bezier_patches(points, u, v);
  ASSERT_EQ(net.size(), across.size() * along.size());
  for (std::size_t number = 0; number < net.size(); ++number) {
    const auto& [left, right] = across[number % across.size()];
    const auto& [low, high] = along[number / across.size()];
    for (int sample = 0; sample < 4; ++sample) {
      const double s = dice.real(), t = dice.real();
      const glm::dvec3 wanted = mean_of(points, weights_at(u, points[0].size(), left + s * (right - left)),
                                        weights_at(v, points.size(), low + t * (high - low)));
      EXPECT_LT(glm::length(patch_point(net[number], s, t) - wanted), 1e-13);
    }
  }
}

TEST(BSpline, IsTheSurfaceThatTheBasisFunctionsMake) {
  Dice dice(1992);
  for (int round = 0; round < 400; ++round) {
    std::size_t columns, rows;
    const SplineDirection u = dice.direction(columns), v = dice.direction(rows);
    SCOPED_TRACE(round);
    expect_same_surface(dice.points(columns, rows), u, v, dice);
  }
}

TEST(BSpline, NeighboursShareTheirPointsBitForBitAcrossSeamsToo) {
  Dice dice(7);
  for (int round = 0; round < 100; ++round) {
    std::size_t columns, rows;
    const SplineDirection u = dice.direction(columns), v = dice.direction(rows);
    const Net net = bezier_patches(dice.points(columns, rows), u, v);
    const std::size_t width = spans_of(u, columns).size(), height = net.size() / width;
    for (std::size_t row = 0; row < height; ++row)
      for (std::size_t column = 0; column < width; ++column) {
        const auto& patch = net[row * width + column];
        const auto& right = net[row * width + (column + 1) % width];
        const auto& above = net[(row + 1) % height * width + column];
        for (std::size_t k = 0; k < 4; ++k) {
          if (u.periodic || column + 1 < width) {
            EXPECT_EQ(patch[4 * k + 3], right[4 * k]);
          }
          if (v.periodic || row + 1 < height) {
            EXPECT_EQ(patch[12 + k], above[k]);
          }
        }
      }
  }
}

TEST(BSpline, StaysWithinTheHullOfItsPoints) {
  Dice dice(3);
  for (int round = 0; round < 100; ++round) {
    std::size_t columns, rows;
    const SplineDirection u = dice.direction(columns), v = dice.direction(rows);
    PointGrid points = dice.points(columns, rows);
    for (auto& row : points)
      for (glm::dvec3& point : row) point = {std::round(point.x), 1, 0};  // on a side of the cube, at its corners
    for (const auto& patch : bezier_patches(points, u, v))
      for (const glm::dvec3& point : patch) {
        EXPECT_GE(point.x, 0);
        EXPECT_LE(point.x, 1);
        EXPECT_EQ(point.y, 1) << "equal points stay as they are";
        EXPECT_EQ(point.z, 0);
      }
  }
}

const SplineDirection kLine{1, false, {0, 0, 1, 1}};

// Curves, as the first row of a surface of two.
std::vector<glm::dvec3> curve_of(const std::vector<glm::dvec3>& points, const SplineDirection& u) {
  std::vector<glm::dvec3> curve;
  for (const auto& patch : bezier_patches({points, points}, u, kLine)) {
    if (!curve.empty()) curve.pop_back();
    curve.insert(curve.end(), patch.begin(), patch.begin() + 4);
  }
  return curve;
}

void expect_same_point(const glm::dvec3& point, const glm::dvec3& wanted) {
  EXPECT_LT(glm::length(point - wanted), 1e-15);
}

// Piegl and Tiller, The NURBS Book, example 3.1: degree 2 over these knots, C(5/2) = P2/8 + 6/8 P3 + P4/8.
TEST(BSpline, HasTheValueOfTheNurbsBook) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i * i / 64.0, i / 8.0, (i % 3) / 3.0});
  const Net net = bezier_patches({points, points}, {2, false, {0, 0, 0, 1, 2, 3, 4, 4, 5, 5, 5}}, kLine);
  ASSERT_EQ(net.size(), 5u);
  expect_same_point(patch_point(net[2], 0.5, 0), points[2] / 8.0 + points[3] * 0.75 + points[4] / 8.0);
  expect_same_point(net[3][3], points[5]);  // the double knot: the curve goes through the point
}

TEST(BSpline, UniformCubicsMeetAtOneFourOne) {
  const std::vector<glm::dvec3> p = {{0, 0, 0}, {0.25, 1, 0}, {0.5, 0, 1}, {1, 0.5, 0.25}, {1, 1, 1}};
  const auto open = curve_of(p, uniform_direction(Ends::open, 3, 5));
  ASSERT_EQ(open.size(), 7u);
  expect_same_point(open[0], (p[0] + 4.0 * p[1] + p[2]) / 6.0);
  expect_same_point(open[1], (2.0 * p[1] + p[2]) / 3.0);
  expect_same_point(open[3], (p[1] + 4.0 * p[2] + p[3]) / 6.0);
  const auto closed = curve_of(p, uniform_direction(Ends::periodic, 3, 5));
  ASSERT_EQ(closed.size(), 16u);
  expect_same_point(closed[0], (p[2] + 4.0 * p[3] + p[4]) / 6.0);
  EXPECT_EQ(closed[0], closed[15]);
}

TEST(BSpline, ClampedEndsAreTheOutermostPoints) {
  const std::vector<glm::dvec3> p = {{0, 0.1, 0}, {0.25, 1, 0}, {0.5, 0, 1}, {1, 0.5, 0.3}, {0.7, 1, 1}};
  for (const int degree : {1, 2, 3}) {
    const auto curve = curve_of(p, uniform_direction(Ends::clamped, degree, 5));
    EXPECT_EQ(curve.size(), static_cast<std::size_t>(3 * (5 - degree) + 1));
    EXPECT_EQ(curve.front(), p.front());
    EXPECT_EQ(curve.back(), p.back());
  }
}

TEST(BSpline, OfBezierKnotsIsTheBezierPatchItself) {
  Dice dice(5);
  const PointGrid points = dice.points(4, 4);
  const SplineDirection bezier{3, false, {0, 0, 0, 0, 1, 1, 1, 1}};
  const Net net = bezier_patches(points, bezier, bezier);
  ASSERT_EQ(net.size(), 1u);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(net[0][i], points[i / 4][i % 4]);
}

}  // namespace
}  // namespace mars::modeler
