// Patches in eye space: the basis, edges' canonical direction, rates that keep their tolerance, and what is
// out of sight.
#include "node/shape/bezier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "tests/node/shape/patches.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shape {
namespace {

const ShapeKernels& kernels = shape_kernels(simd::best_instruction_set(""));

bool same_bits(const Curve& a, const Curve& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(Bezier, BasisSumsToOne) {
  for (int rate = 1; rate <= kMaxRate; ++rate) {
    const Basis& basis = shape::basis(rate);
    EXPECT_EQ(basis.rate, rate);
    for (int i = 0; i <= rate; ++i) {
      double cubic = 0, quadratic = 0, mean = 0;
      for (int k = 0; k < 4; ++k) cubic += basis.cubic[k][i], mean += k * basis.cubic[k][i] / 3.0;
      for (int k = 0; k < 3; ++k) quadratic += basis.quadratic[k][i];
      EXPECT_NEAR(cubic, 1, 2e-7);
      EXPECT_NEAR(quadratic, 1, 2e-7);
      EXPECT_NEAR(mean, static_cast<double>(i) / rate, 2e-7);
    }
  }
}

// So that a curve's ends are its control points bit for bit.
TEST(Bezier, BasisIsExactAtBothEnds) {
  for (int rate = 1; rate <= kMaxRate; ++rate) {
    const Basis& basis = shape::basis(rate);
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(basis.cubic[k][0], k == 0 ? 1.0f : 0.0f);
      EXPECT_EQ(basis.cubic[k][rate], k == 3 ? 1.0f : 0.0f);
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(basis.quadratic[k][0], k == 0 ? 1.0f : 0.0f);
      EXPECT_EQ(basis.quadratic[k][rate], k == 2 ? 1.0f : 0.0f);
    }
  }
}

TEST(Bezier, SharedEdgesAreOneCurveFromBothSides) {
  Random random(11);
  const Projection view = projection(640, 480, 2);
  for (int trial = 0; trial < 2000; ++trial) {
    const EyePatch a = random_patch(random, {0, 0, -8}, 3);
    EyePatch b = random_patch(random, {0, 0, -8}, 3);
    const Side of_a = kSides[random.whole(0, 3)], of_b = kSides[random.whole(0, 3)];
    auto points = side_points(a, of_a);
    if (trial % 5 == 0) points[3] = points[0];  // closed: the inner points decide
    EyePatch first = a;
    set_side_points(first, of_a, points);
    const bool against = random.whole(0, 1) == 1;
    if (against) std::reverse(points.begin(), points.end());
    set_side_points(b, of_b, points);
    const Edge one = edge(first, of_a), other = edge(b, of_b);
    EXPECT_TRUE(same_bits(one.curve, other.curve));
    EXPECT_EQ(one.reversed != other.reversed, against);
    EXPECT_EQ(shape::rates(kernels, first, view, adaptive()).side[static_cast<int>(of_a)],
              shape::rates(kernels, b, view, adaptive()).side[static_cast<int>(of_b)]);
    EXPECT_EQ(shape::rates(kernels, b, view, adaptive()).side[static_cast<int>(of_b)],
              edge_rate(one.curve, view, adaptive().tolerances.outline));
  }
}

// Distance of p from the segment a b.
double distance(const std::array<double, 2>& p, const std::array<double, 2>& a, const std::array<double, 2>& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

bool visible(const Projection& view, const Vec3& p, double width, double height) {
  const double w = -p[2];
  if (!(w >= view.near && w <= view.far)) return false;
  const auto [x, y] = on_screen(view, p);
  return x >= 0 && x <= width && y >= 0 && y <= height;
}

// The curve's greatest visible distance in pixels from its chord polygon of `rate` steps.
double chord_error(const Curve& curve, int rate, const Projection& view) {
  double worst = 0;
  for (int i = 0; i < rate; ++i) {
    const Vec3 from = point_at(curve, static_cast<double>(i) / rate);
    const Vec3 to = point_at(curve, static_cast<double>(i + 1) / rate);
    if (-from[2] < view.near || -to[2] < view.near) continue;
    const auto a = on_screen(view, from), b = on_screen(view, to);
    for (int k = 1; k < 16; ++k) {
      const Vec3 p = point_at(curve, (i + k / 16.0) / rate);
      if (visible(view, p, 640, 480)) worst = std::max(worst, distance(on_screen(view, p), a, b));
    }
  }
  return worst;
}

// Wherever on the picture.
void expect_edges_within_tolerance(const Projection& view) {
  Random random(12);
  const double slack = 1.01, tolerance = 0.1;
  double worst = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const EyePatch patch = random_patch(random, {random.real(-2, 2), random.real(-2, 2), random.real(-20, -3)},
                                        std::pow(10, random.real(-2, 0.7)));
    const Curve curve = edge(patch, Side::top).curve;
    const int rate = edge_rate(curve, view, static_cast<float>(tolerance));
    ASSERT_GE(rate, 1);
    ASSERT_LE(rate, kMaxRate);
    if (rate == kMaxRate) continue;  // as fine as it gets
    worst = std::max(worst, chord_error(curve, rate, view));
  }
  EXPECT_LE(worst, tolerance * slack);
  EXPECT_GT(worst, tolerance / 3) << "rates are much finer than they need be";
}

TEST(Bezier, EdgeRatesKeepTheirTolerance) {
  expect_edges_within_tolerance(projection(640, 480, 3));
  expect_edges_within_tolerance(parallel_projection(640, 480, 5));
}

// Second differences of d pixels, times six, bound the second derivative. Before the eye a bend across the view shows
// whole (or 1 / cosine longer, if nobody knows yet where), one along it not at all.
TEST(Bezier, EdgeRatesOfAParabola) {
  const Projection view = projection(200, 200, 1);  // 100 pixels a unit at distance 1
  constexpr float kTolerance = 0.1875f;
  const auto steps = [&](double pixels) { return std::sqrt(6 * pixels / (8 * double{kTolerance})); };
  for (const double d : {0.0, 0.02, 0.1, 0.17, 1.0, 5.0, 40.0, 1000.0})
    for (const bool across : {true, false}) {
      const EyePatch patch = make_patch([&](int i, int j) {
        const double off = d / 100 * (i == 1 || i == 2);
        return Vec3{i * 1e-4, j * 1e-4 + (across ? off : 0), -1 - (across ? 0 : off)};
      });
      const int rate = edge_rate(edge(patch, Side::bottom).curve, view, kTolerance);
      if (across) {
        EXPECT_GE(rate, std::min(std::ceil(steps(0.999 * d)), 1.0 * kMaxRate)) << d;
        EXPECT_LE(rate, std::clamp(std::ceil(steps(1.001 * d / view.corner)), 1.0, 1.0 * kMaxRate)) << d;
      } else {
        EXPECT_LE(rate, std::max(1.0, std::ceil(steps(1e-3 * d)))) << d;
      }
    }
}

TEST(Bezier, FixedRatesAreThoseGiven) {
  Random random(13);
  const Rates rates = shape::rates(kernels, random_patch(random, {0, 0, -2}, 1), projection(64, 48, 2), steps(7));
  EXPECT_EQ(rates.u, 7);
  EXPECT_EQ(rates.v, 7);
  for (const int side : rates.side) EXPECT_EQ(side, 7);
}

// The cubic through four points at thirds of its length, as Bezier points.
std::array<double, 4> through(const std::array<double, 4>& p) {
  return {p[0], (-5 * p[0] + 18 * p[1] - 9 * p[2] + 2 * p[3]) / 6, (2 * p[0] - 9 * p[1] + 18 * p[2] - 5 * p[3]) / 6,
          p[3]};
}

// The bicubic patch that is at(i, j) at thirds of its parameters.
template <typename At>
EyePatch patch_through(const At& at) {
  double points[4][4][3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<std::array<double, 4>, 4> rows;  // by j
    for (int j = 0; j < 4; ++j)
      rows[static_cast<std::size_t>(j)] = through({at(0, j)[axis], at(1, j)[axis], at(2, j)[axis], at(3, j)[axis]});
    for (std::size_t i = 0; i < 4; ++i) {
      const auto column = through({rows[0][i], rows[1][i], rows[2][i], rows[3][i]});
      for (std::size_t j = 0; j < 4; ++j) points[j][i][axis] = column[j];
    }
  }
  return make_patch([&](int i, int j) { return Vec3{points[j][i][0], points[j][i][1], points[j][i][2]}; });
}

// Part of a sphere, `turn` radians each way from a longitude and a latitude on.
EyePatch sphere_part(const Vec3& middle, double radius, double longitude, double latitude, double turn) {
  return patch_through([&](int i, int j) {
    const double a = longitude + turn * i / 3, b = latitude + turn * j / 3;
    return Vec3{middle[0] + radius * std::cos(b) * std::cos(a), middle[1] + radius * std::cos(b) * std::sin(a),
                middle[2] + radius * std::sin(b)};
  });
}

Vec3 normal_at(const EyePatch& patch, double u, double v) {
  constexpr double kStep = 1e-4;
  const Vec3 n = cross(point_at(patch, u + kStep, v) - point_at(patch, u - kStep, v),
                       point_at(patch, u, v + kStep) - point_at(patch, u, v - kStep));
  return {n[0] / length(n), n[1] / length(n), n[2] / length(n)};
}

double angle(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(dot(a, b), -1.0, 1.0)); }

// How far the surface lies off the triangles of its inside grid, along its normal and as it is seen, in pixels; and
// how much its normal turns from one step to the next, where steps are long.
struct GridError {
  double outline = 0;
  double turn = 0;
};

GridError grid_error(const EyePatch& patch, const Rates& rates, const Projection& view, float least_step) {
  GridError worst;
  for (int j = 0; j < rates.v; ++j)
    for (int i = 0; i < rates.u; ++i) {
      const double du = 1.0 / rates.u, dv = 1.0 / rates.v, u = i * du, v = j * dv;
      const Vec3 a = point_at(patch, u, v), b = point_at(patch, u + du, v), c = point_at(patch, u + du, v + dv);
      const Vec3 flat{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3};
      const Vec3 p = point_at(patch, u + 2 * du / 3, v + dv / 3), n = normal_at(patch, u + 2 * du / 3, v + dv / 3);
      const double pixels = view.scale / -p[2], toward = dot(n, p) / length(p);
      const double off = std::abs(dot(p - flat, n)) * std::sqrt(std::max(0.0, 1 - toward * toward)) * pixels;
      worst.outline = std::max(worst.outline, off);
      const Vec3 at_b = normal_at(patch, u + du, v);
      if (length(b - a) * pixels > least_step) worst.turn = std::max(worst.turn, angle(normal_at(patch, u, v), at_b));
      if (length(c - b) * pixels > least_step)
        worst.turn = std::max(worst.turn, angle(at_b, normal_at(patch, u + du, v + dv)));
    }
  return worst;
}

// Of pictures of one sample a pixel and of several.
void check_inside_rates(std::uint32_t samples) {
  Random random(14);
  const Projection view = projection(640, 480, 3);
  const Dicing dicing = adaptive(samples);
  const Tolerances& allowed = dicing.tolerances;
  GridError worst;
  std::uint64_t cells = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const EyePatch patch =
        sphere_part({random.real(-2, 2), random.real(-2, 2), random.real(-20, -5)}, std::pow(10, random.real(-2, 0.3)),
                    random.real(0, 6.28), random.real(-1.2, 0.3), random.real(0.1, 0.9));
    const Rates rates = shape::rates(kernels, patch, view, dicing);
    cells += static_cast<std::uint64_t>(rates.u * rates.v);
    const GridError error = grid_error(patch, rates, view, allowed.least_step);
    worst = {std::max(worst.outline, error.outline), std::max(worst.turn, error.turn)};
  }
  EXPECT_LE(worst.outline, 2 * allowed.outline);
  EXPECT_GT(worst.outline, allowed.outline / 3) << "rates are much finer than they need be";
  EXPECT_LE(worst.turn, 1.1 * allowed.turn);
  EXPECT_GT(worst.turn, allowed.turn / 2) << "rates are much finer than they need be";
  EXPECT_GT(cells, 400u * 4);
}

TEST(Bezier, InsideRatesKeepOutlinesAndTurns) { check_inside_rates(1); }
TEST(Bezier, InsideRatesKeepFinerOutlinesAndTurnsWithSeveralSamples) { check_inside_rates(4); }

// What one sample a pixel hides, several show.
TEST(Bezier, SeveralSamplesAskForAFinerOutline) {
  const Tolerances one = tolerances_of(1);
  for (const std::uint32_t samples : {2u, 4u, 8u, 16u}) {
    const Tolerances several = tolerances_of(samples);
    EXPECT_LT(several.outline, one.outline) << samples;
    EXPECT_LT(several.turn, one.turn) << samples;
    EXPECT_LT(several.least_step, 1) << samples << ": rims thinner than a pixel show";
  }
}

// The curvature's bits are the same for all instruction sets.
TEST(Bezier, RatesAreTheSameEverywhere) {
  Random random(19);
  const Projection view = projection(640, 480, 2);
  for (int trial = 0; trial < 3000; ++trial) {
    const EyePatch patch = random_patch(random, {0, 0, random.real(-20, 1)}, std::pow(10, random.real(-3, 1)));
    const Rates expected = shape::rates(shape_kernels(simd::InstructionSet::sse2), patch, view, adaptive());
    for (const simd::InstructionSet set : simd::all_sets())
      ASSERT_EQ(shape::rates(shape_kernels(set), patch, view, adaptive()), expected)
          << simd::name_of(set) << ' ' << trial;
  }
}

wire::Matrix random_matrix(Random& random, double size) {
  wire::Matrix matrix;
  for (auto& row : matrix.m)
    for (double& m : row) m = random.real(-size, size);
  return matrix;
}

TEST(Bezier, EyeMatrixIsTheProductRoundedOnce) {
  Random random(15);
  for (int trial = 0; trial < 500; ++trial) {
    const wire::Matrix a = random_matrix(random, 100), b = random_matrix(random, 100);
    const EyeMatrix product = eye_matrix(a, b);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) {
        long double exact = c == 3 ? a.m[r][3] : 0;
        for (std::size_t k = 0; k < 3; ++k) exact += static_cast<long double>(a.m[r][k]) * b.m[k][c];
        EXPECT_NEAR(product.m[r][c], static_cast<double>(exact), std::abs(static_cast<double>(exact)) * 6.0e-8 + 1e-10);
      }
    const auto column = [&](std::size_t c) { return Vec3{product.m[0][c], product.m[1][c], product.m[2][c]}; };
    EXPECT_EQ(mirrors(product), dot(cross(column(0), column(1)), column(2)) < 0);
  }
}

TEST(Bezier, ToEyeMapsControlPoints) {
  Random random(16);
  const EyeMatrix matrix = eye_matrix(random_matrix(random, 3), random_matrix(random, 3));
  wire::Patch patch;
  for (auto& p : patch.points)
    for (float& c : p) c = static_cast<float>(random.real(0, 1));
  const EyePatch out = to_eye(matrix, patch);
  for (std::size_t k = 0; k < 16; ++k)
    for (std::size_t r = 0; r < 3; ++r) {
      double exact = matrix.m[r][3];
      for (std::size_t c = 0; c < 3; ++c) exact += double{matrix.m[r][c]} * patch.points[k][c];
      EXPECT_NEAR(out.point[k][r], exact, 1e-5);
    }
}

void expect_unseen_have_no_place(const Projection& view) {
  Random random(17);
  int unseen = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vec3 middle{random.real(-30, 30), random.real(-30, 30), random.real(-60, 10)};
    const EyePatch patch = random_patch(random, middle, std::pow(10, random.real(-2, 1.5)));
    if (!shape::unseen(patch, view, 640, 480)) continue;
    ++unseen;
    for (int j = 0; j <= 12; ++j)
      for (int i = 0; i <= 12; ++i) ASSERT_FALSE(visible(view, point_at(patch, i / 12.0, j / 12.0), 640, 480));
  }
  EXPECT_GT(unseen, 5000);
  EXPECT_LT(unseen, 19000);
}

TEST(Bezier, UnseenPatchesHaveNoPlaceInThePicture) {
  expect_unseen_have_no_place(projection(640, 480, 2, 0.5, 50));
  expect_unseen_have_no_place(parallel_projection(640, 480, 30, 0.5, 50));
}

// Each of the six ways out is noticed.
TEST(Bezier, PatchesBesideThePictureAreUnseen) {
  Random random(18);
  const Projection view = projection(640, 480, 2, 0.5, 50);
  for (const Vec3& middle : {Vec3{0, 0, 5}, Vec3{0, 0, -0.1}, Vec3{0, 0, -60}, Vec3{-9, 0, -10}, Vec3{9, 0, -10},
                             Vec3{0, 7, -10}, Vec3{0, -7, -10}})
    EXPECT_TRUE(shape::unseen(random_patch(random, middle, 0.3), view, 640, 480));
  EXPECT_FALSE(shape::unseen(random_patch(random, {0, 0, -10}, 0.3), view, 640, 480));
  // Four high, and shifted: from -2.13 to 3.2 and from -2.8 to 1.2.
  const Projection parallel = parallel_projection(640, 480, 4, 0.5, 50);
  for (const Vec3& middle :
       {Vec3{0, 0, 0.5}, Vec3{0, 0, -51}, Vec3{-2.6, 0, -40}, Vec3{3.7, 0, -1}, Vec3{0, 1.7, -40}, Vec3{0, -3.3, -1}})
    EXPECT_TRUE(shape::unseen(random_patch(random, middle, 0.3), parallel, 640, 480));
  EXPECT_FALSE(shape::unseen(random_patch(random, {2.8, -2.4, -40}, 0.3), parallel, 640, 480));
}

}  // namespace
}  // namespace mars::shape
