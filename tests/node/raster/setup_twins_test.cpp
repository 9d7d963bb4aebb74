// Set-up sixteen at a time, set-up one by one and the tests' plain set-up make the same of a patch: triangles and
// edge boxes in the same order with the same bits, from every instruction set.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "node/shape/dice.h"
#include "tests/node/raster/plain_set_up.h"
#include "tests/node/raster/set_ups.h"
#include "tests/node/shape/patches.h"
#include "tests/node/shape/sample_counts.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::raster {
namespace {

using shape::Dicer;
using shape::EyePatch;

constexpr std::int32_t kTwinWidth = 200, kTwinHeight = 150;
const shape::Projection kTwinView = shape::projection(kTwinWidth, kTwinHeight, 2, 0.1, 1000);
const double kScale = kTwinView.scale;

// `turned_over` counts those that snapping turned over.
Made expected_of(const std::vector<PlainTriangle>& plain, const shape::SamplePattern& pattern, bool moving,
                 int* turned_over) {
  Made out;
  out.line_loads.resize(kTwinHeight);
  for (const PlainTriangle& t : plain) {
    auto boxes = plain_edge_boxes(t.corners, kTwinWidth, kTwinHeight, pattern);
    if (boxes.empty()) continue;
    *turned_over += t.faces != (area(t.corners) < 0);
    for (UnsortedEdgeBox& unsorted : boxes) {
      unsorted.box.triangle = static_cast<std::uint32_t>(out.triangles.size());
      unsorted.moving = moving;
      out.line_loads[unsorted.line] += load_of(unsorted);
      out.boxes.push_back(unsorted);
    }
    out.triangles.push_back(t.record);
  }
  out.touching = out.triangles.size();
  out.edge_boxes = out.boxes.size();
  return out;
}

template <typename T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// The ways that triangles went, so that a test can check that it tested them.
struct Paths {
  int decided = 0;
  int undecided = 0;
  int clipped = 0;
  int dropped = 0;
  int edge_boxes = 0;
  int turned_over = 0;  // by snapping, of those that cover samples

  void count(simd::InstructionSet set, const shape::SamplePattern& pattern, const Dicer& diced,
             const PatchIdentity& identity) {
    if (diced.reaches_outside()) {
      clipped += static_cast<int>(diced.triangles().count);
      return;
    }
    Classified e;
    for (std::uint32_t b = 0; b < diced.triangles().batch_count; ++b) {
      const shape::Batch& batch = diced.triangles().batches[b];
      raster_kernels(set).classify({kTwinWidth, kTwinHeight, pattern, identity.one_sided, identity.mirrored},
                                   diced.vertices(), diced.triangles(), batch, e);
      decided += std::popcount(e.decided);
      undecided += std::popcount(e.undecided);
      dropped += static_cast<int>(batch.last - batch.first) - std::popcount(e.decided | e.undecided);
    }
  }
};

class SetUpTwins : public testing::Test {
 protected:
  SetUpTwins() {
    for (const simd::InstructionSet set : simd::sets_here()) dicers.push_back({set, Dicer(set)});
  }
  void TearDown() override { simd::skip_sets_not_here(); }

  // With each number of samples in turn, and where lights cast and do not.
  void expect_same(const EyePatch& patch, int rate, const PatchIdentity& identity) {
    const Picture picture{kTwinView, kTwinWidth, kTwinHeight,
                          shape::kSampleCounts[calls % std::size(shape::kSampleCounts)], calls % 2 == 1};
    ++calls;
    const shape::SamplePattern& pattern = shape::sample_pattern(picture.samples);
    Made expected;
    for (auto& [set, dicer] : dicers) {
      dicer.dice(patch, kTwinView, shape::steps(rate));
      if (set == dicers[0].first) {
        expected = expected_of(plain_set_up(dicer, kTwinView, identity, picture.casting), pattern, identity.moving,
                               &paths.turned_over);
        paths.count(set, pattern, dicer, identity);
        paths.edge_boxes += static_cast<int>(expected.edge_boxes);
      }
      for (const Way way : {Way::at_a_time, Way::plainly}) {
        SCOPED_TRACE(std::string(simd::name_of(set)) + (way == Way::plainly ? ", plainly" : ", at a time"));
        const Made made = set_up(set, picture, dicer, identity, way);
        ASSERT_TRUE(same_bytes(made.triangles, expected.triangles));
        ASSERT_TRUE(same_bytes(made.boxes, expected.boxes));
        ASSERT_EQ(made.line_loads, expected.line_loads);
        ASSERT_EQ(made.touching, expected.touching);
        ASSERT_EQ(made.edge_boxes, expected.edge_boxes);
        ASSERT_TRUE(made.all_stored);
      }
    }
  }

  std::vector<std::pair<simd::InstructionSet, Dicer>> dicers;
  Paths paths;
  std::size_t calls = 0;
};

PatchIdentity random_identity(shape::Random& random) {
  return {random.bits(), random.bits() % 9, random.whole(0, 1) == 1, random.whole(0, 2) == 0, random.whole(0, 1) == 1};
}

// The place seen at (x, y) pixels from the picture's left and top.
shape::Vec3 seen_at(double x, double y, double away) {
  return {(x - kTwinView.center[0]) / kScale * away, -(y - kTwinView.center[1]) / kScale * away, -away};
}

EyePatch bilinear(const shape::Vec3 (&corner)[4]) {
  return shape::make_patch([&](int i, int j) {
    shape::Vec3 out{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double below = corner[0][axis] + (corner[1][axis] - corner[0][axis]) * i / 3;
      const double above = corner[3][axis] + (corner[2][axis] - corner[3][axis]) * i / 3;
      out[axis] = below + (above - below) * j / 3;
    }
    return out;
  });
}

using MakePatch = std::function<EyePatch(shape::Random&)>;

EyePatch crumpled(shape::Random& random) {
  return shape::random_patch(random,
                             seen_at(random.real(0, kTwinWidth), random.real(0, kTwinHeight), random.real(3, 8)),
                             std::pow(10, random.real(-3, 0.5)));
}

EyePatch needle(shape::Random& random) {
  EyePatch patch = crumpled(random);
  const int axis = random.whole(0, 2);
  const auto thin = static_cast<float>(std::pow(10, random.real(-6, -1)));
  for (auto& point : patch.point) point[axis] = patch.point[0][axis] + thin * (point[axis] - patch.point[0][axis]);
  return patch;
}

// A sheet whose plane runs through the eye, or nearly, by turns as thin as a line and as a ground one walks on.
EyePatch edge_on(shape::Random& random) {
  const double tilt = random.whole(0, 3) ? std::pow(10, random.real(-4, -0.5)) : 0, bend = random.whole(0, 1) * 1e-3;
  const double near = random.real(0.3, 2), deep = random.real(0.1, 9), wide = random.real(0.1, 2),
               y = random.real(-0.2, 0.2);
  return shape::make_patch([&](int i, int j) {
    const double away = near + deep * j / 3;
    return shape::Vec3{wide * (i - 1.5), y * away - tilt + bend * ((i ^ j) & 1) * away, -away};
  });
}

EyePatch beyond_the_picture(shape::Random& random) {
  const double away = random.real(1, 5), size = away * random.real(0.5, 20);
  return shape::make_patch([&](int i, int j) {
    return shape::Vec3{size * (i - 1.5) + random.real(-0.1, 0.1), size * (j - 1.4), -away - 0.1 * random.real(0, 1)};
  });
}

EyePatch over_the_border(shape::Random& random) {
  const double x = random.whole(0, 1) * kTwinWidth, y = random.whole(0, 1) * kTwinHeight;
  return shape::random_patch(random,
                             random.whole(0, 1) ? seen_at(x, random.real(0, kTwinHeight), 4)
                                                : seen_at(random.real(0, kTwinWidth), y, 4),
                             std::pow(10, random.real(-2, 0)));
}

// Cut by near, where they are large by the guard band too, and where they are largest by far.
EyePatch through_the_eye(shape::Random& random) {
  return shape::random_patch(random, {0, 0, random.real(-2, 1)}, std::pow(10, random.real(-0.5, 3.5)));
}

EyePatch ball(shape::Random& random) {
  return shape::sphere_octant(seen_at(random.real(0, kTwinWidth), random.real(0, kTwinHeight), 5),
                              std::pow(10, random.real(-2, 0.2)));
}

// Vertices on samples, or on pixels' borders, for the rates that divide 60.
EyePatch lattice(shape::Random& random) {
  const int cell = random.whole(1, 3), shift = random.whole(-70, 170);
  const double half = random.whole(0, 2) ? 0.5 : 0;
  const double left = shift + half, top = random.whole(-70, 120) + half, size = 60.0 * cell;
  const bool turned = random.whole(0, 1) == 1;
  const shape::Vec3 a = seen_at(left, top + size, kScale), b = seen_at(left + size, top + size, kScale),
                    c = seen_at(left + size, top, kScale), d = seen_at(left, top, kScale);
  return turned ? bilinear({a, d, c, b}) : bilinear({a, b, c, d});
}

struct Kind {
  const char* name;
  MakePatch make;
  int least_decided, least_undecided, least_clipped;  // in 120 trials
};

TEST_F(SetUpTwins, MakeTheSameOfAllKindsOfPatches) {
  shape::Random random(83);
  const Kind kinds[] = {{"crumpled", crumpled, 5000, 300, 0},
                        {"needle", needle, 1500, 150, 0},
                        {"edge-on", edge_on, 1500, 150, 0},
                        {"beyond the picture", beyond_the_picture, 300, 300, 0},
                        {"over the border", over_the_border, 1500, 150, 0},
                        {"through the eye", through_the_eye, 3000, 60, 150000},
                        {"ball", ball, 1500, 100, 0},
                        {"lattice", lattice, 13000, 30, 0}};
  for (const Kind& kind : kinds) {
    paths = {};
    for (int trial = 0; trial < 120; ++trial) {
      SCOPED_TRACE(std::string(kind.name) + ", trial " + std::to_string(trial));
      const int rates[] = {0, 1, 2, 3, 5, 10, 15, 20, 30};
      expect_same(kind.make(random), rates[trial % 9], random_identity(random));
      if (HasFatalFailure()) return;
    }
    SCOPED_TRACE(kind.name);
    EXPECT_GE(paths.decided, kind.least_decided);
    EXPECT_GE(paths.undecided, kind.least_undecided);
    EXPECT_GE(paths.clipped, kind.least_clipped);
    EXPECT_GT(paths.edge_boxes, 1000);
  }
}

// Strips as long as the picture and about 1/256 pixel thin: snapping turns some of their triangles over.
TEST_F(SetUpTwins, MakeTheSameOfWhatSnappingTurnsOver) {
  shape::Random random(82);
  for (int trial = 0; trial < 1000; ++trial) {
    const double x = random.real(0, kTwinWidth), y = random.real(0, kTwinHeight), to_x = random.real(0, kTwinWidth),
                 to_y = random.real(0, kTwinHeight);
    const auto near = [&](double place) { return place + random.real(-1, 1) / 256; };
    expect_same(bilinear({seen_at(near(x), near(y), 3), seen_at(near(to_x), near(to_y), 4),
                          seen_at(near(to_x), near(to_y), 4), seen_at(near(x), near(y), 3)}),
                random.whole(1, 2), random_identity(random));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(paths.turned_over, 7);
  EXPECT_GT(paths.undecided, 1000);
}

// A quad with corners at these 1/256 pixels, each as far away as it likes.
EyePatch planted(shape::Random& random, const std::int32_t (&x)[4], const std::int32_t (&y)[4]) {
  shape::Vec3 corner[4];
  for (std::size_t k = 0; k < 4; ++k) corner[k] = seen_at(x[k] / 256.0, y[k] / 256.0, kScale * random.whole(1, 4));
  return bilinear({corner[0], corner[1], corner[2], corner[3]});
}

// Triangles as wide or high as those that are decided, and as thin as what snapping may turn over, but for 1/256 pixel.
TEST_F(SetUpTwins, MakeTheSameWhereDecidingEnds) {
  shape::Random random(81);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::int32_t left = random.whole(-6000, 200 * 256), top = random.whole(-6000, 150 * 256);
    const bool large = random.whole(0, 1) == 1;
    const std::int32_t far = random.whole(0, 1500);
    const std::int32_t width = large ? kMostExtent * 128 + random.whole(-1, 1) : 4 * far + 20 + random.whole(-1, 1);
    const std::int32_t height = large ? kMostExtent * 128 + random.whole(-1, 1) : 5;
    const std::int32_t a = large ? 0 : random.whole(0, far), b = large ? random.whole(0, 300) : 0;
    const std::int32_t x[4] = {left, left + width, left + width - a, left + a},
                       y[4] = {top + height, top + height - b, top, top + b};
    const bool turned = random.whole(0, 1) == 1;
    const EyePatch patch = turned ? planted(random, y, x) : planted(random, x, y);
    dicers[0].second.dice(patch, kTwinView, shape::steps(1));
    const std::int32_t* snapped = dicers[0].second.vertices().x;
    ASSERT_EQ(std::set(snapped, snapped + dicers[0].second.vertex_count()),
              turned ? std::set(y, y + 4) : std::set(x, x + 4));
    expect_same(patch, 1, random_identity(random));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(paths.decided, 150);
  EXPECT_GT(paths.undecided, 150);
}

}  // namespace
}  // namespace mars::raster
