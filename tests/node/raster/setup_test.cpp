// Set-ups of diced patches: which way they face, what their plane equations say, and which of them are emitted.
#include "node/raster/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "node/shape/dice.h"
#include "node/simd/instruction_set.h"
#include "tests/node/raster/plain_set_up.h"
#include "tests/node/raster/set_ups.h"
#include "tests/node/shape/patches.h"
#include "tests/node/shape/sample_counts.h"

namespace mars::raster {
namespace {

using geometry::Triangle;
using shape::Dicer;
using shape::EyePatch;
using shape::Side;
using shape::Value;

constexpr std::int32_t kWidth = 640, kHeight = 480;
const shape::Projection kView = shape::projection(kWidth, kHeight, 2);

// Set-ups, with the corners and numbers that they no longer have.
struct Emitted : Made {
  std::vector<Corners> corners;        // of each triangle
  std::vector<std::uint32_t> indices;  // in the patch's dicing
};

// A triangle with its edge boxes.
struct Whole {
  Triangle triangle;
  std::vector<UnsortedEdgeBox> boxes;
};

// How often memory was short, and how often something was stored nevertheless.
struct Shortage {
  int short_of_memory = 0;
  int partly_stored = 0;
};

class SetUpTest : public testing::Test {
 protected:
  Picture picture(const shape::Projection& view = kView) const { return {view, kWidth, kHeight, samples}; }
  Emitted set_up(const EyePatch& patch, int rate, const PatchIdentity& identity = {5, 3, false, false, false},
                 const shape::Projection& view = kView) {
    dicer.dice(patch, view, shape::steps(rate));
    Emitted emitted{raster::set_up(set, picture(view), dicer, identity), {}, {}};
    EXPECT_TRUE(emitted.all_stored);
    for (const PlainTriangle& plain : plain_set_up(dicer, view, identity)) {
      if (plain_edge_boxes(plain.corners, kWidth, kHeight, shape::sample_pattern(samples)).empty()) continue;
      emitted.corners.push_back(plain.corners);
      emitted.indices.push_back(plain.index);
    }
    EXPECT_EQ(emitted.corners.size(), emitted.triangles.size());
    return emitted;
  }
  // With that many bytes counts go on, what is stored of `all` is stored whole (`whole`: its triangles), and nothing
  // is written elsewhere.
  void expect_counted(const Made& all, const std::vector<Whole>& whole, std::size_t bytes, Way way, Shortage& out);
  // Batches in which decided triangles follow undecided ones.
  int mixed_batches() const;

  const simd::InstructionSet set = simd::best_instruction_set("");
  Dicer dicer{set};
  std::uint32_t samples = 1;
};

// A square before the eye, outside turned to it.
EyePatch square(double size, double away) {
  return shape::make_patch([&](int i, int j) {
    return shape::Vec3{size * (i / 1.5 - 1), size * (j / 1.5 - 1), -away};
  });
}

double at(const Triangle& t, Value value, double dx, double dy) {
  return t.at_first[value] + dy * t.per_y[value] + dx * t.per_x[value];
}

// Square pixels.
double square_pixels(const Corners& t) { return std::abs(static_cast<double>(area(t))) / 131072; }

double covered(const Emitted& emitted) {
  double sum = 0;
  for (const Corners& t : emitted.corners) sum += square_pixels(t);
  return sum;
}

// How often samples of a line are covered, all together.
int samples_on(const Made& made, std::int32_t line) {
  int samples = 0;
  for (const UnsortedEdgeBox& unsorted : made.boxes)
    if (unsorted.line == line) samples += static_cast<int>(unsorted.box.width());
  return samples;
}

TEST_F(SetUpTest, CarriesWhatThePatchIs) {
  const Emitted emitted = set_up(square(1, 4), 3);
  ASSERT_EQ(emitted.triangles.size(), 18u);
  for (std::uint32_t k = 0; k < 18; ++k) {
    EXPECT_EQ(emitted.triangles[k].patch, 5u);
    EXPECT_EQ(emitted.triangles[k].material, 3u);
    EXPECT_EQ(emitted.indices[k], k);
  }
  EXPECT_NEAR(covered(emitted), 240 * 240, 2);  // 2 units of 480 / 4 pixels
}

// Seen from outside and inside, as it is and through a mirror, with one side and with two.
TEST_F(SetUpTest, OneSidedAreSeenFromOutsideOnly) {
  const EyePatch front = square(1, 4), back = shape::swapped(front);
  for (const bool mirrored : {false, true}) {
    EXPECT_EQ(set_up(front, 2, {0, 0, mirrored, true, false}).touching, mirrored ? 0u : 8u);
    EXPECT_EQ(set_up(back, 2, {0, 0, mirrored, true, false}).touching, mirrored ? 8u : 0u);
    EXPECT_EQ(set_up(front, 2, {0, 0, mirrored, false, false}).touching, 8u);
    EXPECT_EQ(set_up(back, 2, {0, 0, mirrored, false, false}).touching, 8u);
  }
}

// As nodes do it: the matrix is applied, and whether it mirrors is asked of the matrix.
TEST_F(SetUpTest, MirroredBodiesShowTheirOutside) {
  wire::Patch patch;
  for (std::size_t k = 0; k < 16; ++k)
    patch.points[k] = {static_cast<float>(k % 4) / 3, static_cast<float>(k / 4) / 3, 0};
  for (const int flip : {0, 1, 2, 3, 4, 5, 6, 7}) {
    shape::EyeMatrix matrix{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -4}}};
    for (int axis = 0; axis < 3; ++axis)
      if (flip >> axis & 1) matrix.m[axis][axis] = -1;
    const PatchIdentity identity{0, 0, shape::mirrors(matrix), true, false};
    const bool outside = (flip & 4) == 0;  // the outside is +z
    EXPECT_EQ(set_up(shape::to_eye(matrix, patch), 2, identity).touching, outside ? 8u : 0u) << flip;
  }
}

TEST_F(SetUpTest, NormalsAreTurnedToTheEye) {
  const EyePatch octant = shape::sphere_octant({0, 0, -4}, 1);
  for (const EyePatch& patch : {octant, shape::swapped(octant), shape::turned(octant)})
    for (const bool mirrored : {false, true}) {
      const Emitted emitted = set_up(patch, 12, {0, 0, mirrored, false, false});
      ASSERT_GT(emitted.triangles.size(), 100u);
      for (std::size_t k = 0; k < emitted.triangles.size(); ++k) {
        const Triangle& t = emitted.triangles[k];
        const auto& [cx, cy] = emitted.corners[k];
        const double dx = (cx[1] + cx[2] - 2 * cx[0]) / 3.0, dy = (cy[1] + cy[2] - 2 * cy[0]) / 3.0;
        const double w = 1 / at(t, shape::kDepth, dx, dy);
        const double x = (cx[0] + dx) / 256 - kView.center[0], y = (cy[0] + dy) / 256 - kView.center[1];
        const shape::Vec3 to_eye{-x / kView.scale, y / kView.scale, 1};
        const shape::Vec3 normal{at(t, shape::kNormalX, dx, dy) * w, at(t, shape::kNormalY, dx, dy) * w,
                                 at(t, shape::kNormalZ, dx, dy) * w};
        EXPECT_NEAR(shape::length(normal), 1, 0.02);
        EXPECT_GT(shape::dot(normal, to_eye), -0.07) << "but for the sphere's rim, where facets and normals differ";
      }
    }
}

// Each value at a vertex is what the vertex had.
TEST_F(SetUpTest, PlanesGoThroughTheVertices) {
  shape::Random random(40);
  int checked = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const EyePatch patch = shape::random_patch(random, {0, 0, -6}, 1);
    const Emitted emitted = set_up(patch, 6);
    const shape::Vertices& v = dicer.vertices();
    for (std::size_t n = 0; n < emitted.triangles.size(); ++n) {
      const Triangle& t = emitted.triangles[n];
      const shape::Corner3 corners = dicer.triangles()[emitted.indices[n]];
      const std::uint32_t number[] = {corners.a, corners.b, corners.c};
      ASSERT_EQ(t.first_x, v.x[corners.a]);
      ASSERT_EQ(t.first_y, v.y[corners.a]);
      if (square_pixels(emitted.corners[n]) < 0.5) continue;  // rounding decides the planes of slivers
      const double sign = area(emitted.corners[n]) < 0 ? 1 : -1;
      for (const std::uint32_t k : number) {
        const double dx = v.x[k] - t.first_x, dy = v.y[k] - t.first_y, w = 1 / v.values[k][shape::kDepth];
        EXPECT_NEAR(at(t, shape::kDepth, dx, dy) * w, 1, 1e-4);
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_NEAR(at(t, static_cast<Value>(shape::kNormalX + axis), dx, dy) * w, sign * v.normal[axis][k], 1e-3);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 5000);
}

TEST_F(SetUpTest, DropsWhatTouchesNoSample) {
  EXPECT_EQ(set_up(shape::make_patch([](int, int) { return shape::Vec3{0, 0, -4}; }), 4).touching, 0u);  // a point
  EXPECT_EQ(set_up(shape::make_patch([](int i, int j) {
                     return shape::Vec3{i * 0.1, j * 0.0, -4};
                   }),
                   4)
                .touching,
            0u);                                       // a line
  EXPECT_EQ(set_up(square(1e-4, 4), 1).touching, 0u);  // between samples
  EXPECT_EQ(set_up(square(1, -4), 1).touching, 0u);    // behind
  const EyePatch beside = shape::make_patch([](int i, int j) { return shape::Vec3{5 + i / 3.0, j / 3.0, -4}; });
  EXPECT_EQ(set_up(beside, 3).touching, 0u);
}

// A plane one walks on, from far behind the eye to the horizon, fills the picture below that without a hole.
TEST_F(SetUpTest, GroundReachesPastTheEye) {
  const shape::Projection view = shape::projection(kWidth, kHeight, 2, 0.05, 1e7);
  for (const double size : {10.0, 1e3, 1e4, 1e5, 1e6})
    for (const int rate : {0, 1, 4, 7}) {
      const EyePatch ground = shape::make_patch([&](int i, int j) {
        return shape::Vec3{size * (i - 1.4), -1, size * (1.6 - j)};
      });
      const Emitted emitted = set_up(ground, rate, {0, 0, false, true, false}, view);
      int holes = 0;
      for (std::int32_t line = 300; line < kHeight; ++line) holes += samples_on(emitted, line) != kWidth;
      EXPECT_EQ(holes, 0) << "size " << size << ", rate " << rate;
    }
}

// A square of 2 pixels round a corner of four holds the samples of those four.
TEST_F(SetUpTest, CountsEdgeBoxes) {
  for (const std::uint32_t count : shape::kSampleCounts) {
    samples = count;
    const Emitted emitted = set_up(square(1.0 / 120, 4), 1);  // 1 pixel is 1/120 unit: [319, 321) x [239, 241)
    EXPECT_EQ(emitted.touching, 2u);
    EXPECT_EQ(emitted.edge_boxes, emitted.line_loads[239].boxes() + emitted.line_loads[240].boxes());
    EXPECT_EQ(samples_on(emitted, 239), static_cast<int>(2 * samples));
    EXPECT_EQ(samples_on(emitted, 240), static_cast<int>(2 * samples));
    for (std::uint32_t line = 0; line < kHeight; ++line)
      EXPECT_EQ(emitted.line_loads[line].boxes() > 0, line == 239 || line == 240) << line;
  }
}

std::size_t bytes_of(const Made& made) {
  return made.triangles.size() * sizeof(Triangle) + made.boxes.size() * sizeof(UnsortedEdgeBox);
}

std::vector<Whole> by_triangle(const Made& made) {
  std::vector<Whole> out;
  for (const Triangle& t : made.triangles) out.push_back({t, {}});
  for (const UnsortedEdgeBox& unsorted : made.boxes) out.at(unsorted.box.triangle).boxes.push_back(unsorted);
  return out;
}

bool same_but_for_number(const UnsortedEdgeBox& a, const UnsortedEdgeBox& b) {
  return a.box.first == b.box.first && a.box.last() == b.box.last() && a.box.sample == b.box.sample &&
         a.line == b.line && a.moving == b.moving;
}

void SetUpTest::expect_counted(const Made& all, const std::vector<Whole>& whole, std::size_t bytes, Way way,
                               Shortage& out) {
  SCOPED_TRACE(std::to_string(bytes) + (way == Way::plainly ? " bytes, plainly" : " bytes, at a time"));
  const Made some = raster::set_up(set, picture(), dicer, {5, 3, false, false, false}, way, {}, bytes);
  ASSERT_EQ(some.touching, all.touching);
  ASSERT_EQ(some.edge_boxes, all.edge_boxes);
  ASSERT_EQ(some.line_loads, all.line_loads);
  ASSERT_EQ(some.all_stored, some.boxes.size() == all.boxes.size());
  ASSERT_LE(bytes_of(some), bytes);
  ASSERT_TRUE(bytes >= bytes_of(all) || !some.all_stored);
  ASSERT_TRUE(bytes < bytes_of(all) + samples * kHeight * sizeof(UnsortedEdgeBox) + sizeof(Triangle) ||
              some.all_stored);
  auto next = whole.begin();  // what is stored is some of all triangles, in order
  for (const Whole& one : by_triangle(some)) {
    while (next != whole.end() && std::memcmp(&next->triangle, &one.triangle, sizeof(Triangle)) != 0) ++next;
    ASSERT_NE(next, whole.end());
    ASSERT_TRUE(
        std::equal(one.boxes.begin(), one.boxes.end(), next->boxes.begin(), next->boxes.end(), same_but_for_number));
    ++next;
  }
  out.short_of_memory += !some.all_stored;
  out.partly_stored += !some.all_stored && !some.triangles.empty();
}

int SetUpTest::mixed_batches() const {
  int mixed = 0;
  Classified e;
  for (std::uint32_t b = 0; b < dicer.triangles().batch_count; ++b) {
    raster_kernels(set).classify({kWidth, kHeight, shape::sample_pattern(samples), false, false}, dicer.vertices(),
                                 dicer.triangles(), dicer.triangles().batches[b], e);
    mixed += e.undecided != 0 && e.decided > (e.undecided & -e.undecided);
  }
  return mixed;
}

TEST_F(SetUpTest, CountsOnWhenMemoryIsShort) {
  // A ground: large triangles near by, small ones far away, next to each other in their order too.
  const EyePatch ground = shape::make_patch([&](int i, int j) {
    return shape::Vec3{0.7 * (i - 1.5), -0.1 - 0.05 * j, -0.3 - 1.2 * j};
  });
  // A strip that grows narrow: triangles as high as the picture and low ones in one batch.
  const EyePatch wedge = shape::make_patch([](int i, int j) {
    return shape::Vec3{0.3 * (i - 1.5), (j / 1.5 - 1) * (1.7 - 0.56 * i), -3.5 - 0.2 * (i == 1 || i == 2)};
  });
  dicer.dice(wedge, kView, shape::adaptive());
  EXPECT_GT(mixed_batches(), 0);
  for (const EyePatch& patch :
       {shape::sphere_octant({0, 0, -4}, 1), ground, shape::swapped(ground), wedge, shape::turned(wedge)})
    for (const int rate : {0, 2, 9}) {
      samples = rate == 2 ? 4 : 1;
      const Emitted all = set_up(patch, rate);
      const std::vector<Whole> whole = by_triangle(all);
      Shortage shortage;
      const std::size_t most = bytes_of(all) + samples * kHeight * sizeof(UnsortedEdgeBox) + sizeof(Triangle);
      for (std::size_t bytes = 0; bytes < most + 500; bytes += bytes < 600 ? 12 : 4 * (1 + most / 200))
        for (const Way way : {Way::at_a_time, Way::plainly}) {
          expect_counted(all, whole, bytes, way, shortage);
          if (HasFailure()) return;
        }
      EXPECT_GT(shortage.partly_stored, 30);
    }
}

TEST_F(SetUpTest, KeepsWhatIsOnWantedLines) {
  samples = 2;
  const Emitted all = set_up(square(1, 4), 9);
  std::vector<std::uint8_t> wanted(kHeight);
  std::fill(wanted.begin() + 200, wanted.begin() + 230, std::uint8_t{1});
  wanted[300] = 1;
  std::vector<Whole> expected;
  std::vector<LineLoad> loads(kHeight);
  for (const Whole& one : by_triangle(all)) {
    Whole on_wanted{one.triangle, {}};
    for (const UnsortedEdgeBox& unsorted : one.boxes)
      if (wanted[unsorted.line]) on_wanted.boxes.push_back(unsorted);
    for (const UnsortedEdgeBox& unsorted : on_wanted.boxes) loads[unsorted.line] += load_of(unsorted);
    if (!on_wanted.boxes.empty()) expected.push_back(on_wanted);
  }
  EXPECT_LT(expected.size(), all.triangles.size());
  EXPECT_GT(expected.size(), 0u);
  for (const Way way : {Way::at_a_time, Way::plainly}) {
    const Made some = raster::set_up(set, picture(), dicer, {5, 3, false, false, false}, way, wanted);
    EXPECT_TRUE(some.all_stored);
    EXPECT_EQ(some.touching, expected.size());
    EXPECT_EQ(some.edge_boxes, some.boxes.size());
    EXPECT_EQ(some.line_loads, loads);
    const auto found = by_triangle(some);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(std::memcmp(&found[k].triangle, &expected[k].triangle, sizeof(Triangle)), 0);
      EXPECT_TRUE(std::equal(found[k].boxes.begin(), found[k].boxes.end(), expected[k].boxes.begin(),
                             expected[k].boxes.end(), same_but_for_number));
    }
  }
}

// Edge boxes say whose they are, row after row, and whether it moves.
TEST_F(SetUpTest, EdgeBoxesFollowTheirTriangles) {
  samples = 8;
  const auto row = [&](const UnsortedEdgeBox& box) { return samples * box.line + box.box.sample; };
  for (const bool moving : {false, true}) {
    const Emitted emitted = set_up(square(1, 4), 5, {5, 3, false, false, moving});
    ASSERT_EQ(emitted.boxes.size(), emitted.edge_boxes);
    for (std::size_t k = 0; k < emitted.boxes.size(); ++k) {
      const UnsortedEdgeBox& here = emitted.boxes[k];
      EXPECT_EQ(here.moving, moving);
      ASSERT_LT(here.box.triangle, emitted.triangles.size());
      if (k == 0) continue;
      const UnsortedEdgeBox& before = emitted.boxes[k - 1];
      if (here.box.triangle == before.box.triangle)
        EXPECT_GT(row(here), row(before));
      else
        EXPECT_EQ(here.box.triangle, before.box.triangle + 1);
    }
  }
}

}  // namespace
}  // namespace mars::raster
