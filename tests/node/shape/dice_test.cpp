// Dicing: meshes without T-joints at any rates, neighbours that share every vertex of their edge, and normals
// where a side is collapsed to a point.
#include "node/shape/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "node/simd/instruction_set.h"
#include "tests/node/shape/diced.h"

namespace mars::shape {
namespace {

const Projection kView = projection(640, 480, 2);

// A height field over the unit square: x and y are the parameters, bends along rows and columns and how far
// away each corner is decide the rates.
EyePatch random_hills(Random& random) {
  double row[4], column[4];
  const double size = std::pow(10, random.real(-4, -1.4));
  for (double& bend : row) bend = size * (random.whole(0, 2) ? random.real(-1, 1) : 0);
  for (double& bend : column) bend = size * (random.whole(0, 2) ? random.real(-1, 1) : 0);
  if (random.whole(0, 2) == 0) std::fill(row + 1, row + 4, row[0]);
  if (random.whole(0, 2) == 0) std::fill(column + 1, column + 4, column[0]);
  const double away = random.real(1, 4), along_u = random.real(0, 9), along_v = random.real(0, 9);
  return make_patch([&](int i, int j) {
    const double bend = row[j] * (i == 1 || i == 2) + column[i] * (j == 1 || j == 2);
    return Vec3{i / 3.0, j / 3.0, bend - away - along_u * i / 3 - along_v * j / 3};
  });
}

// Twice the areas in parameters of each of the mesh's triangles.
std::vector<double> areas(const Mesh& mesh) {
  std::vector<double> out;
  for (const auto& face : mesh.faces) {
    const auto at = [&](std::size_t k) { return mesh.places[static_cast<std::size_t>(face[k])]; };
    Vec3 b = at(1) - at(0), c = at(2) - at(0);
    out.push_back(b[0] * c[1] - b[1] * c[0]);
  }
  return out;
}

void expect_tiled(const Mesh& mesh) {
  double sum = 0;
  for (const double area : areas(mesh)) {
    EXPECT_GT(area, 0);
    sum += area / 2;
  }
  EXPECT_NEAR(sum, 1, 1e-5);
}

// Side rates 1..5 and inside rates 1..6, as far as patches have them: an inside is never coarser than its
// sides.
TEST(Dice, AnyRatesMakeADiscWithoutTJoints) {
  Random random(20);
  Dicer dicer(simd::best_instruction_set(""));
  std::set<std::array<int, 6>> reached;
  for (int trial = 0; trial < 60000; ++trial) {
    const EyePatch patch = random_hills(random);
    const Rates rates = shape::rates(shape_kernels(simd::best_instruction_set("")), patch, kView, adaptive());
    if (*std::max_element(rates.side, rates.side + 4) > 5 || rates.u > 6 || rates.v > 6) continue;
    const std::array<int, 6> key{rates.u, rates.v, rates.side[0], rates.side[1], rates.side[2], rates.side[3]};
    if (!reached.insert(key).second) continue;
    dicer.dice(patch, kView, adaptive());
    const Mesh mesh = mesh_of(dicer);
    expect_tiled(mesh);
    ASSERT_TRUE(sound_disc(mesh, patch, rates)) << "inside " << rates.u << " x " << rates.v << ", sides " << key[2]
                                                << ' ' << key[3] << ' ' << key[4] << ' ' << key[5];
  }
  EXPECT_GT(reached.size(), 500u);
}

// Rates far apart, up to the largest.
TEST(Dice, HighAndUnequalRates) {
  Random random(21);
  Dicer dicer(simd::best_instruction_set(""));
  for (const double size : {1.0, 30.0, 1e4})
    for (const Side side : kSides) {
      EyePatch patch = make_patch([](int i, int j) { return Vec3{i / 3.0, j / 3.0, -3}; });
      auto points = side_points(patch, side);
      points[1][2] -= static_cast<float>(size);
      points[2][2] += static_cast<float>(0.1 * size);
      set_side_points(patch, side, points);
      dicer.dice(patch, kView, adaptive());
      const Mesh mesh = mesh_of(dicer);
      expect_tiled(mesh);
      ASSERT_TRUE(sound_disc(mesh, patch,
                             shape::rates(shape_kernels(simd::best_instruction_set("")), patch, kView, adaptive())));
    }
}

TEST(Dice, FixedRateGivesTwoTrianglesAQuad) {
  Dicer dicer(simd::best_instruction_set(""));
  const EyePatch patch = make_patch([](int i, int j) { return Vec3{i / 3.0, j / 3.0, -3 + 0.1 * i * j}; });
  for (const int rate : {1, 2, 3, 4, 5, 8, 17, 64, 256}) {
    dicer.dice(patch, kView, steps(rate));
    EXPECT_EQ(dicer.triangles().count, static_cast<std::uint32_t>(2 * rate * rate));
    const Mesh mesh = mesh_of(dicer);
    expect_tiled(mesh);
    EXPECT_EQ(mesh.places.size(), static_cast<std::size_t>((rate + 1) * (rate + 1)));
    ASSERT_TRUE(sound_disc(mesh, patch, {rate, rate, {rate, rate, rate, rate}}));
  }
}

// Every side of one with every side of the other, in the same and in opposite directions.
TEST(Dice, NeighboursShareTheirEdgesVertices) {
  Random random(22);
  Dicer dicer(simd::best_instruction_set(""));
  for (int trial = 0; trial < 128; ++trial) {
    const Side of_a = kSides[trial % 4], of_b = kSides[trial / 4 % 4];
    const EyePatch a = random_patch(random, {0, 0, -8}, 0.5);
    auto points = side_points(a, of_a);
    if (trial / 16 % 2) std::reverse(points.begin(), points.end());
    EyePatch b = random_patch(random, {0, 0, -8}, random.whole(0, 1) ? 0.01 : 3);
    set_side_points(b, of_b, points);
    const int rate = edge_rate(edge(a, of_a).curve, kView, adaptive().tolerances.outline);
    dicer.dice(a, kView, adaptive());
    const auto vertices = boundary_vertices(dicer);
    dicer.dice(b, kView, adaptive());
    std::size_t shared = 0;
    for (const ScreenVertex& vertex : boundary_vertices(dicer)) shared += vertices.contains(vertex);
    EXPECT_EQ(shared, static_cast<std::size_t>(rate + 1)) << "trial " << trial;
  }
}

Vec3 normal_of(const Dicer& diced, int k) {
  const Vertices& v = diced.vertices();
  return {v.normal[0][k], v.normal[1][k], v.normal[2][k]};
}

Vec3 place_of(const Dicer& diced, int k) {
  const Vertices& v = diced.vertices();
  return {v.place[0][k], v.place[1][k], v.place[2][k]};
}

constexpr double kDegree = 0.0174532925;

// The angle between the vertex's normal and `right`.
double turned_from(const Dicer& diced, int k, const Vec3& right) {
  const Vec3 normal = normal_of(diced, k);
  EXPECT_NEAR(length(normal), 1, 1e-5);
  return std::atan2(length(cross(normal, right)), dot(normal, right));
}

TEST(Dice, NormalsOfASphereAndItsPole) {
  const Vec3 middle{0.3, -0.4, -5};
  Dicer dicer(simd::best_instruction_set(""));
  const EyePatch octant = sphere_octant(middle, 1);
  const EyePatch sideways = turned(swapped(octant));  // the pole on the left, the inside outside
  for (const auto& [patch, out] : {std::pair{octant, 1}, {turned(octant), 1}, {swapped(octant), -1}, {sideways, -1}})
    for (const int rate : {0, 1, 2, 3, 16}) {
      dicer.dice(patch, kView, steps(rate));
      double worst = 0;
      for (int k = 0; k < dicer.vertex_count(); ++k) {
        const Vec3 outward = place_of(dicer, k) - middle;
        worst = std::max(worst, turned_from(dicer, k, {out * outward[0], out * outward[1], out * outward[2]}));
      }
      EXPECT_LT(worst, kDegree) << "rate " << rate;
    }
}

// At the apex each vertex has the normal of its own generator.
TEST(Dice, NormalsOfAConeAndItsApex) {
  const Vec3 middle{0.3, -0.4, -5};
  const double height = 2;
  Dicer dicer(simd::best_instruction_set(""));
  for (const int rate : {0, 2, 9}) {
    dicer.dice(cone_quarter(middle, 0, height), kView, steps(rate));
    double least = 10, most = -10;
    for (int k = 0; k < dicer.vertex_count(); ++k) {
      const Vec3 from_axis = place_of(dicer, k) - middle;
      const bool apex = from_axis[1] > height - 1e-6;
      const Vec3 normal = normal_of(dicer, k);
      const double around = apex ? std::atan2(normal[0], normal[2]) : std::atan2(from_axis[0], from_axis[2]);
      EXPECT_LT(turned_from(dicer, k, {height * std::sin(around), 1, height * std::cos(around)}), kDegree);
      if (!apex) continue;
      least = std::min(least, around);
      most = std::max(most, around);
    }
    EXPECT_NEAR(least, 0, kDegree) << "rate " << rate;
    EXPECT_NEAR(most, 90 * kDegree, kDegree) << "rate " << rate;
  }
}

// A point, a needle, a patch folded on itself: no normal is worse than none.
TEST(Dice, DegeneratePatchesHaveFiniteNormals) {
  Dicer dicer(simd::best_instruction_set(""));
  const auto patches = {make_patch([](int, int) {
                          return Vec3{1, 1, -4};
                        }),
                        make_patch([](int i, int) {
                          return Vec3{i / 3.0, 1, -4};
                        }),
                        make_patch([](int i, int j) {
                          return Vec3{(i - 1.5) * (i - 1.5), j * 0.1, -4};
                        }),
                        make_patch([](int i, int j) {
                          return Vec3{i * j * 1e-20, j * 1e-20, -4};
                        })};
  for (const EyePatch& patch : patches)
    for (const int rate : {0, 1, 4}) {
      dicer.dice(patch, kView, steps(rate));
      for (int k = 0; k < dicer.vertex_count(); ++k) {
        const double size = length(normal_of(dicer, k));
        EXPECT_TRUE(size == 0 || std::abs(size - 1) < 1e-5) << size;
      }
    }
}

TEST(Dice, ACylindersSideIsAStrip) {
  const Vec3 middle{0, -1, -4};
  Dicer dicer(simd::best_instruction_set(""));
  const EyePatch cylinder = cone_quarter(middle, 1, 2);
  for (const EyePatch& patch : {cylinder, swapped(cylinder)}) {
    const Rates rates = shape::rates(shape_kernels(simd::best_instruction_set("")), patch, kView, adaptive());
    const bool upright = rates.v == 1;
    EXPECT_EQ(upright ? rates.v : rates.u, 1);
    const int along = rates.side[upright ? 0 : 1];
    EXPECT_GT(along, 3);
    dicer.dice(patch, kView, adaptive());
    EXPECT_EQ(dicer.triangles().count, static_cast<std::uint32_t>(2 * along));
    ASSERT_TRUE(sound_disc(mesh_of(dicer), patch, rates));
    for (int k = 0; k < dicer.vertex_count(); ++k) {
      const Vec3 from_axis = place_of(dicer, k) - middle;
      const double out = upright ? 1 : -1;
      EXPECT_LT(turned_from(dicer, k, {out * from_axis[0], 0, out * from_axis[2]}), kDegree);
    }
  }
}

}  // namespace
}  // namespace mars::shape
