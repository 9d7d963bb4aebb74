#include "host/content/modeler/subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>

#include "host/content/modeler/bspline.h"

namespace mars::modeler {
namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

// `columns` x `rows` quads, u along x; `round`: closed along u.
Cage grid(std::uint32_t columns, std::uint32_t rows) {
  Cage cage{(columns + 1) * (rows + 1), {}};
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (columns + 1) + i; };
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i)
      cage.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return cage;
}

Cage cube() { return {8, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}}; }

std::vector<glm::dvec3> cube_points() {
  std::vector<glm::dvec3> points;
  for (int corner = 0; corner < 8; ++corner) points.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2);
  return points;
}

// Uneven, but always the same.
std::vector<glm::dvec3> some_points(std::size_t count) {
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(0.5 + 0.5 * std::sin(3.0 * double(i)), 0.5 + 0.5 * std::sin(7.0 * double(i) + 1),
                        0.5 + 0.5 * std::cos(5.0 * double(i)));
  return points;
}

glm::dvec3 vector(const std::array<float, 3>& point) { return {point[0], point[1], point[2]}; }

double apart(const wire::Patch& one, const wire::Patch& other) {
  double most = 0;
  for (std::size_t i = 0; i < 16; ++i)
    most = std::max(most, glm::distance(vector(one.points[i]), vector(other.points[i])));
  return most;
}

// Where corners join four quads a cage is a bicubic B-spline surface, whose border is a spline too; the corners of the
// whole are sharp.
TEST(Subdivision, OfARegularGridIsTheBspline) {
  const auto points = some_points(6 * 5);
  const std::vector<wire::Patch> patches = patches_of(subdivided(grid(5, 4), 0), points);
  PointGrid rows;
  for (std::size_t j = 0; j < 5; ++j)
    rows.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(6 * j),
                      points.begin() + static_cast<std::ptrdiff_t>(6 * (j + 1)));
  const std::vector<wire::Patch> inner =
      rounded(bezier_patches(rows, uniform_direction(Ends::open, 3, 6), uniform_direction(Ends::open, 3, 5)));
  ASSERT_EQ(patches.size(), 20u);
  ASSERT_EQ(inner.size(), 6u);
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(apart(patches[5 * (j + 1) + i + 1], inner[3 * j + i]), 1e-6);
}

// A step changes no surface where its patches are exact: each patch's quarters are patches of the next level.
TEST(Subdivision, LevelsAgreeWherePatchesAreExact) {
  const auto points = some_points(7 * 7);
  const Cage cage = grid(6, 6);
  const std::vector<wire::Patch> coarse = patches_of(subdivided(cage, 0), points),
                                 fine = patches_of(subdivided(cage, 1), points);
  ASSERT_EQ(fine.size(), 4 * coarse.size());
  const auto middle = [](const wire::Patch& patch) {
    constexpr double kPart[] = {0.125, 0.375, 0.375, 0.125};
    glm::dvec3 place(0);
    for (std::size_t i = 0; i < 16; ++i) place += kPart[i % 4] * kPart[i / 4] * vector(patch.points[i]);
    return place;
  };
  for (std::size_t face = 0; face < coarse.size(); ++face)
    for (std::size_t corner = 0; corner < 4; ++corner)  // its quads' third corner is in its middle
      EXPECT_LT(glm::distance(middle(coarse[face]), vector(fine[4 * face + corner].points[15])), 1e-6) << face;
}

// Halstead, Kass, DeRose 1993: where the surface of a cage goes through at a corner of valence n.
TEST(Subdivision, CornersAreOnTheLimitSurface) {
  const auto points = cube_points();
  const std::vector<wire::Patch> coarse = patches_of(subdivided(cube(), 0), points),
                                 fine = patches_of(subdivided(cube(), 3), points);
  const auto has = [](const std::vector<wire::Patch>& patches, const glm::dvec3& place) {
    return std::ranges::any_of(patches, [&](const wire::Patch& patch) {
      return std::ranges::any_of(patch.points, [&](const auto& p) { return glm::distance(vector(p), place) < 1e-6; });
    });
  };
  for (const wire::Patch& patch : coarse)
    for (const std::size_t corner : {0, 3, 12, 15}) EXPECT_TRUE(has(fine, vector(patch.points[corner])));
}

// Closed, within the cage, and turned to the outside.
TEST(Subdivision, OfACubeIsClosedAndRound) {
  for (const int level : {0, 1, 2, 3}) {
    const MeanPatches means = subdivided(cube(), level);
    EXPECT_EQ(means.patches.size(), 6u << 2 * level);
    std::vector<std::array<std::uint32_t, 4>> sides;
    for (const wire::PatchStencils& p : means.patches)
      for (const std::array<std::size_t, 4>& side :
           {std::array<std::size_t, 4>{0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}})
        sides.push_back({p[side[0]], p[side[1]], p[side[2]], p[side[3]]});
    for (const auto& side : sides) {
      std::array<std::uint32_t, 4> back = side;
      std::ranges::reverse(back);
      EXPECT_EQ(std::ranges::count(sides, back), 1);
    }
    for (const wire::Patch& patch : patches_of(means, cube_points())) {
      for (const auto& point : patch.points)
        EXPECT_LT(glm::distance(vector(point), glm::dvec3(0.5)), level == 0 ? 0.7 : 0.6);
      const glm::dvec3 u = vector(patch.points[1]) - vector(patch.points[0]),
                       v = vector(patch.points[4]) - vector(patch.points[0]);
      EXPECT_GT(glm::dot(glm::cross(u, v), vector(patch.points[0]) - glm::dvec3(0.5)), 0);
    }
  }
}

TEST(Subdivision, WeightsAreMeans) {
  for (const Mean& mean : subdivided(cube(), 2).means) {
    EXPECT_NEAR(
        std::accumulate(mean.begin(), mean.end(), 0.0, [](double sum, const Term& t) { return sum + t.weight; }), 1,
        1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(mean, std::less_equal<>(), &Term::point));
    for (const Term& term : mean) EXPECT_GT(term.weight, 0);
  }
}

constexpr std::array<std::array<std::size_t, 4>, 4> kSides = {
    {{0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}}};

// In the middle of a side.
glm::dvec3 normal_at(const wire::Patch& patch, const std::array<std::size_t, 4>& side) {
  constexpr double kPart[] = {0.125, 0.375, 0.375, 0.125};
  const int inward = side[0] == 0 ? 4 : side[0] == 3 ? -1 : side[0] == 15 ? -4 : 1;
  const auto at = [&](std::size_t i) { return vector(patch.points[side[i]]); };
  glm::dvec3 across(0);
  for (std::size_t i = 0; i < 4; ++i)
    across += kPart[i] * (vector(patch.points[static_cast<std::size_t>(static_cast<int>(side[i]) + inward)]) - at(i));
  return glm::normalize(glm::cross(at(3) + at(2) - at(1) - at(0), across));
}

// Degrees between the normals of neighbours, at most.
double worst_edge(const Cage& cage, int level, const std::vector<glm::dvec3>& points) {
  const MeanPatches means = subdivided(cage, level);
  const std::vector<wire::Patch> patches = patches_of(means, points);
  double most = 0;
  for (std::size_t one = 0; one < patches.size(); ++one)
    for (std::size_t other = 0; other < patches.size(); ++other)
      for (const auto& a : kSides)
        for (const auto& b : kSides) {
          if (means.patches[one][a[1]] != means.patches[other][b[2]]) continue;
          const double cosine = glm::dot(normal_at(patches[one], a), normal_at(patches[other], b));
          most = std::max(most, glm::degrees(std::acos(std::min(1.0, cosine))));
        }
  return most;
}

// The same where corners join four, and nearly so elsewhere, the better the deeper.
TEST(Subdivision, NeighboursMeetSmoothly) {
  EXPECT_LT(worst_edge(grid(4, 4), 0, some_points(25)), 1e-2);
  std::vector<glm::dvec3> uneven = cube_points();
  uneven[7] = {0.7, 0.9, 1};
  const double coarse = worst_edge(cube(), 1, uneven), fine = worst_edge(cube(), 3, uneven);
  EXPECT_GT(coarse, 0.01);
  EXPECT_LT(coarse, 8);
  EXPECT_LT(fine, 0.6 * coarse);
}

TEST(Subdivision, NamesFaults) {
  const auto problem = [](const Cage& cage) { return fault_of(cage).value_or(CageFault{}).problem; };
  EXPECT_EQ(problem(cube()), "");
  EXPECT_EQ(problem(grid(3, 2)), "");
  Cage turned = cube();
  std::ranges::reverse(turned.faces[1]);
  EXPECT_NE(problem(turned).find("as face 1 does"), std::string::npos);
  Cage lonely = cube();
  ++lonely.points;
  EXPECT_EQ(problem(lonely), "belongs to no face");
  EXPECT_EQ(problem({7, {{0, 1, 2, 3}, {3, 4, 5, 6}}}), "joins faces that share no edge in it");
  const auto cone = [](std::uint32_t sides) {
    Cage cage{sides + 1, {}};
    for (std::uint32_t side = 0; side < sides; ++side) cage.faces.push_back({side, (side + 1) % sides, sides});
    return cage;
  };
  EXPECT_EQ(problem(cone(kMostAround)), "");
  EXPECT_EQ(problem(cone(kMostAround + 1)), "joins 65 faces");
}

// A pole of a loft, whose control points are one at rest, stays one.
TEST(ControlNets, JoinPointsThatAreTheSame) {
  PointGrid rows(5, std::vector<glm::dvec3>(6));
  std::vector<glm::dvec3> all;
  std::vector<VertexBones> bones;
  for (std::size_t j = 0; j < 5; ++j)
    for (std::size_t i = 0; i < 6; ++i) {
      const double angle = double(i), reach = j == 0 || j == 4 ? 0 : 0.37;
      rows[j][i] = {0.5 + reach * std::cos(angle), 0.5 + reach * std::sin(angle), 0.1 + 0.2 * double(j)};
      all.push_back(rows[j][i]);
      bones.push_back({{0, 1}, {1 - 0.25f * float(j), 0.25f * float(j)}});
    }
  bones[bones.size() - 2] = {{0}, {1}};
  const SplineDirection u = uniform_direction(Ends::periodic, 3, 6), v = uniform_direction(Ends::clamped, 3, 5);
  const ControlNet net = control_net(bezier_means(6, 5, u, v), all, bones, 6);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(net.stencils[i].term_count, 1u);
  EXPECT_GT(net.stencils.back().term_count, 1u);  // one of the other pole's points follows another bone
  const std::vector<wire::Patch> still = patches_of(net, all), patches = rounded(bezier_patches(rows, u, v));
  ASSERT_EQ(still.size(), patches.size());
  for (std::size_t i = 0; i < still.size(); ++i) EXPECT_LT(apart(still[i], patches[i]), 1e-6);
}

}  // namespace
}  // namespace mars::modeler
