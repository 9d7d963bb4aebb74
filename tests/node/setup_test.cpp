// Set-ups of diced patches: which way they face, what their plane equations say, and which of them are kept.
#include "node/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/node/patches.h"

namespace mars::test {
namespace {

using node::Dicer;
using node::EyePatch;
using node::PatchIdentity;
using node::Plane;
using node::SetUps;
using node::Side;
using node::Triangle;

constexpr std::int32_t kWidth = 640, kHeight = 480;
const node::Projection kView = projection(kWidth, kHeight, 2);

struct Kept {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> line_counts;
  std::uint64_t touching = 0;
  std::uint64_t edge_boxes = 0;
};

class SetUpTest : public testing::Test {
 protected:
  Kept set_up(const EyePatch& patch, int rate, const PatchIdentity& identity = {5, 3, false, false},
              const node::Projection& view = kView) {
    dicer.dice(patch, view, rate);
    Kept kept{std::vector<Triangle>(200000), std::vector<std::uint32_t>(kHeight)};
    SetUps out{.triangles = kept.triangles, .line_counts = kept.line_counts, .wanted_lines = {}};
    node::SetUp(kernels, view, kWidth, kHeight).add(dicer, identity, out);
    kept.triangles.resize(out.stored);
    kept.touching = out.touching;
    kept.edge_boxes = out.edge_boxes;
    return kept;
  }

  const node::Kernels& kernels = node::best_kernels("");
  Dicer dicer{kernels};
};

// A square before the eye, outside turned to it.
EyePatch square(double size, double away) {
  return make_patch([&](int i, int j) { return Vec3{size * (i / 1.5 - 1), size * (j / 1.5 - 1), -away}; });
}

double at(const Plane& plane, double dx, double dy) {
  return plane.at_first + dy * plane.per_y + dx * plane.per_x;
}

// Twice the area, in square pixels.
double area(const Triangle& t) {
  const double x1 = t.x[1] - t.x[0], x2 = t.x[2] - t.x[0], y1 = t.y[1] - t.y[0], y2 = t.y[2] - t.y[0];
  return (x1 * y2 - x2 * y1) / 65536;
}

double covered(const Kept& kept) {
  double sum = 0;
  for (const Triangle& t : kept.triangles) sum += std::abs(area(t)) / 2;
  return sum;
}

// How often samples of a line are covered, all together.
int samples_on(const Kept& kept, std::int32_t line) {
  int samples = 0;
  for (const Triangle& t : kept.triangles) {
    const node::Crossings crossings(t, kWidth, kHeight);
    if (line < crossings.first_row || line >= crossings.last_row) continue;
    const auto columns = crossings.columns(line);
    samples += std::max(columns.last - columns.first, 0);
  }
  return samples;
}

TEST_F(SetUpTest, CarriesWhatThePatchIs) {
  const Kept kept = set_up(square(1, 4), 3);
  ASSERT_EQ(kept.triangles.size(), 18u);
  for (std::uint32_t k = 0; k < 18; ++k) {
    EXPECT_EQ(kept.triangles[k].patch, 5u);
    EXPECT_EQ(kept.triangles[k].look, 3u);
    EXPECT_EQ(kept.triangles[k].index, k);
  }
  EXPECT_NEAR(covered(kept), 240 * 240, 2);  // 2 units of 480 / 4 pixels
}

// Seen from outside and inside, as it is and through a mirror, with one side and with two.
TEST_F(SetUpTest, OneSidedAreSeenFromOutsideOnly) {
  const EyePatch front = square(1, 4), back = swapped(front);
  for (const bool mirrored : {false, true}) {
    EXPECT_EQ(set_up(front, 2, {0, 0, mirrored, true}).touching, mirrored ? 0u : 8u);
    EXPECT_EQ(set_up(back, 2, {0, 0, mirrored, true}).touching, mirrored ? 8u : 0u);
    EXPECT_EQ(set_up(front, 2, {0, 0, mirrored, false}).touching, 8u);
    EXPECT_EQ(set_up(back, 2, {0, 0, mirrored, false}).touching, 8u);
  }
}

// As nodes do it: the matrix is applied, and whether it mirrors is asked of the matrix.
TEST_F(SetUpTest, MirroredBodiesShowTheirOutside) {
  node::Patch patch;
  for (std::size_t k = 0; k < 16; ++k)
    patch.points[k] = {static_cast<float>(k % 4) / 3, static_cast<float>(k / 4) / 3, 0};
  for (const int flip : {0, 1, 2, 3, 4, 5, 6, 7}) {
    node::EyeMatrix matrix{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -4}}};
    for (int axis = 0; axis < 3; ++axis)
      if (flip >> axis & 1) matrix.m[axis][axis] = -1;
    const PatchIdentity identity{0, 0, node::mirrors(matrix), true};
    const bool outside = (flip & 4) == 0;  // the outside is +z
    EXPECT_EQ(set_up(node::to_eye(matrix, patch), 2, identity).touching, outside ? 8u : 0u) << flip;
  }
}

TEST_F(SetUpTest, NormalsAreTurnedToTheEye) {
  const EyePatch octant = sphere_octant({0, 0, -4}, 1);
  for (const EyePatch& patch : {octant, swapped(octant), turned(octant)})
    for (const bool mirrored : {false, true}) {
      const Kept kept = set_up(patch, 12, {0, 0, mirrored, false});
      ASSERT_GT(kept.triangles.size(), 100u);
      for (const Triangle& t : kept.triangles) {
        const double dx = (t.x[1] + t.x[2] - 2 * t.x[0]) / 3.0, dy = (t.y[1] + t.y[2] - 2 * t.y[0]) / 3.0;
        const double w = 1 / at(t.depth, dx, dy);
        const double x = (t.x[0] + dx) / 256 - kView.center[0], y = (t.y[0] + dy) / 256 - kView.center[1];
        const Vec3 to_eye{-x / kView.scale, y / kView.scale, 1};
        const Vec3 normal{at(t.normal[0], dx, dy) * w, at(t.normal[1], dx, dy) * w,
                          at(t.normal[2], dx, dy) * w};
        EXPECT_NEAR(length(normal), 1, 0.02);
        EXPECT_GT(dot(normal, to_eye), -0.07) << "but for the sphere's rim, where facets and normals differ";
      }
    }
}

// Each value at a vertex is what the vertex had.
TEST_F(SetUpTest, PlanesGoThroughTheVertices) {
  Random random(40);
  for (int trial = 0; trial < 50; ++trial) {
    const EyePatch patch = random_patch(random, {0, 0, -6}, 1);
    const Kept kept = set_up(patch, 6);
    const node::Vertices& v = dicer.vertices();
    for (const Triangle& t : kept.triangles) {
      const node::Corner3& corners = dicer.triangles()[t.index];
      const std::uint32_t number[] = {corners.a, corners.b, corners.c};
      if (std::abs(area(t)) < 1) continue;  // rounding decides the planes of slivers
      const double sign = area(t) < 0 ? 1 : -1;
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(t.x[k], v.x[number[k]]);
        ASSERT_EQ(t.y[k], v.y[number[k]]);
        const double dx = t.x[k] - t.x[0], dy = t.y[k] - t.y[0], w = 1 / v.inverse_w[number[k]];
        EXPECT_NEAR(at(t.depth, dx, dy) * w, 1, 1e-4);
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_NEAR(at(t.normal[axis], dx, dy) * w, sign * v.normal[axis][number[k]], 1e-3);
      }
    }
  }
}

TEST_F(SetUpTest, DropsWhatTouchesNoSample) {
  EXPECT_EQ(set_up(make_patch([](int, int) { return Vec3{0, 0, -4}; }), 4).touching, 0u);  // a point
  EXPECT_EQ(set_up(make_patch([](int i, int j) {
                     return Vec3{i * 0.1, j * 0.0, -4};
                   }),
                   4)
                .touching,
            0u);                                       // a line
  EXPECT_EQ(set_up(square(1e-4, 4), 1).touching, 0u);  // between samples
  EXPECT_EQ(set_up(square(1, -4), 1).touching, 0u);    // behind
  const EyePatch beside = make_patch([](int i, int j) { return Vec3{5 + i / 3.0, j / 3.0, -4}; });
  EXPECT_EQ(set_up(beside, 3).touching, 0u);
}

// A plane one walks on, from far behind the eye to the horizon, fills the picture below that without a hole.
TEST_F(SetUpTest, GroundReachesPastTheEye) {
  const node::Projection view = projection(kWidth, kHeight, 2, 0.05, 1e7);
  for (const double size : {10.0, 1e3, 1e4, 1e5, 1e6})
    for (const int rate : {0, 1, 4, 7}) {
      const EyePatch ground = make_patch([&](int i, int j) {
        return Vec3{size * (i - 1.4), -1, size * (1.6 - j)};
      });
      const Kept kept = set_up(ground, rate, {0, 0, false, true}, view);
      int holes = 0;
      for (std::int32_t line = 300; line < kHeight; ++line) holes += samples_on(kept, line) != kWidth;
      EXPECT_EQ(holes, 0) << "size " << size << ", rate " << rate;
    }
}

// On a lattice of samples: a square of 2 pixels round a corner of four holds those four.
TEST_F(SetUpTest, CountsEdgeBoxes) {
  const Kept kept = set_up(square(1.0 / 120, 4), 1);  // 1 pixel is 1/120 unit: [319, 321) x [239, 241)
  EXPECT_EQ(kept.touching, 2u);
  EXPECT_EQ(kept.edge_boxes, kept.line_counts[239] + kept.line_counts[240]);
  EXPECT_EQ(samples_on(kept, 239), 2);
  EXPECT_EQ(samples_on(kept, 240), 2);
  for (std::uint32_t line = 0; line < kHeight; ++line)
    EXPECT_EQ(kept.line_counts[line] > 0, line == 239 || line == 240) << line;
}

TEST_F(SetUpTest, CountsOnWhenStorageIsFull) {
  const EyePatch patch = square(1, 4);
  const Kept all = set_up(patch, 6);
  for (const std::size_t room : {std::size_t{0}, std::size_t{1}, all.triangles.size() - 1}) {
    std::vector<Triangle> triangles(room);
    std::vector<std::uint32_t> counts(kHeight);
    SetUps out{.triangles = triangles, .line_counts = counts, .wanted_lines = {}};
    node::SetUp(kernels, kView, kWidth, kHeight).add(dicer, {5, 3, false, false}, out);
    EXPECT_EQ(out.stored, room);
    EXPECT_EQ(out.touching, all.touching);
    EXPECT_EQ(out.edge_boxes, all.edge_boxes);
    EXPECT_EQ(counts, all.line_counts);
    for (std::size_t k = 0; k < room; ++k)
      EXPECT_EQ(std::memcmp(&triangles[k], &all.triangles[k], sizeof(Triangle)), 0);
  }
}

TEST_F(SetUpTest, KeepsWhatTouchesWantedLines) {
  const Kept all = set_up(square(1, 4), 9);
  std::vector<std::uint8_t> wanted(kHeight);
  std::fill(wanted.begin() + 200, wanted.begin() + 230, std::uint8_t{1});
  wanted[300] = 1;
  std::vector<Triangle> triangles(all.triangles.size());
  SetUps out{.triangles = triangles, .line_counts = {}, .wanted_lines = wanted};
  node::SetUp(kernels, kView, kWidth, kHeight).add(dicer, {5, 3, false, false}, out);
  std::vector<std::uint32_t> expected;
  for (const Triangle& t : all.triangles) {
    std::vector<std::uint32_t> counts(kHeight);
    node::count_edge_boxes(node::Crossings(t, kWidth, kHeight), counts);
    bool touches = false;
    for (std::size_t line = 0; line < kHeight; ++line) touches |= counts[line] > 0 && wanted[line] != 0;
    if (touches) expected.push_back(t.index);
  }
  ASSERT_EQ(out.stored, expected.size());
  EXPECT_EQ(out.touching, expected.size());
  EXPECT_LT(expected.size(), all.triangles.size());
  EXPECT_GT(expected.size(), 0u);
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(triangles[k].index, expected[k]);
}

TEST_F(SetUpTest, WithoutCountsAndWishesKeepsAll) {
  const Kept all = set_up(square(1, 4), 4);
  std::vector<Triangle> triangles(all.triangles.size());
  SetUps out{.triangles = triangles, .line_counts = {}, .wanted_lines = {}};
  node::SetUp(kernels, kView, kWidth, kHeight).add(dicer, {5, 3, false, false}, out);
  EXPECT_EQ(out.stored, all.triangles.size());
}

}  // namespace
}  // namespace mars::test
