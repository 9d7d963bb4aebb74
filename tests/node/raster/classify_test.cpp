// The classifying kernel of every instruction set against 64-bit integers: the decided ones of sixteen triangles, and
// their columns row by row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/node/raster/plain_set_up.h"
#include "tests/node/shape/patches.h"
#include "tests/node/shape/sample_counts.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::raster {
namespace {

using shape::kBatchTriangles;

// A batch of triangles and what lies around it in the arrays, which must not matter.
class Batch16 {
 public:
  Batch16(const std::vector<Corners>& triangles, bool consecutive, shape::Random& random) : consecutive_(consecutive) {
    std::vector<std::uint32_t> numbers(kVertices);
    std::iota(numbers.begin(), numbers.end(), 0u);
    if (!consecutive)
      for (std::size_t k = kVertices; k-- > 1;)
        std::swap(numbers[k], numbers[static_cast<std::size_t>(random.whole(0, static_cast<std::int32_t>(k)))]);
    first_ = static_cast<std::uint32_t>(random.whole(0, 20));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      corners_[corner].assign(first_ + kBatchTriangles + simd::kVectorSlack, 0);
      for (std::size_t k = 0; k < kBatchTriangles; ++k) {
        const std::uint32_t number = numbers[corner * kBatchTriangles + k];
        corners_[corner][first_ + k] = number;
        x_[number] = triangles[k].x[corner];
        y_[number] = triangles[k].y[corner];
      }
    }
  }

  // The first `count` of the sixteen.
  Classified classify(simd::InstructionSet set, const ClassifyTask& task, std::uint32_t count) {
    shape::Vertices vertices{};
    vertices.x = x_;
    vertices.y = y_;
    const shape::Batch batch{first_, first_ + count, consecutive_};
    const shape::Triangles triangles{
        corners_[0].data(), corners_[1].data(), corners_[2].data(), first_ + count, &batch, 1};
    Classified out;
    raster_kernels(set).classify(task, vertices, triangles, batch, out);
    return out;
  }

 private:
  static constexpr std::size_t kVertices = 3 * kBatchTriangles;
  bool consecutive_;
  std::uint32_t first_;
  std::vector<std::uint32_t> corners_[3];
  std::int32_t x_[kVertices + simd::kVectorSlack] = {}, y_[kVertices + simd::kVectorSlack] = {};
};

enum State { kDropped, kDecided, kUndecided, kStates };

State state_of(const Classified& c, std::uint32_t lane) {
  EXPECT_EQ(c.decided & c.undecided, 0u);
  return c.decided >> lane & 1 ? kDecided : c.undecided >> lane & 1 ? kUndecided : kDropped;
}

// Of two sides' extents.
constexpr std::int32_t kSmall = kMostExtent * 256 / 2;
bool small(const Corners& t) {
  return std::max({std::abs(t.x[1] - t.x[0]), std::abs(t.y[1] - t.y[0]), std::abs(t.x[2] - t.x[0]),
                   std::abs(t.y[2] - t.y[0])}) < kSmall;
}

// |twice the area| less four 1/256 pixel times the lengths of two sides: what is thin is not above 0.
std::int64_t above_thin(const Corners& t) {
  return std::abs(area(t)) - 4ll * (std::abs(t.x[1] - t.x[0]) + std::abs(t.y[1] - t.y[0]) + std::abs(t.x[2] - t.x[0]) +
                                    std::abs(t.y[2] - t.y[0]));
}

bool right_state(State state, const Corners& t, const ClassifyTask& task, bool covers_any) {
  if (small(t) && above_thin(t) > 0) {
    const bool seen = !task.one_sided || (area(t) < 0) != task.mirrored;
    return state == (seen && covers_any ? kDecided : kDropped);
  }
  if (area(t) == 0 && small(t)) return state == kDropped;
  return covers_any ? state == kUndecided : state != kDecided;
}

// Whether a decided triangle's columns are these edge boxes and nothing else, and its numbers those of its corners.
bool right_columns(const Classified& c, std::uint32_t lane, const Corners& t, const shape::SamplePattern& pattern,
                   const std::vector<UnsortedEdgeBox>& boxes) {
  auto next = boxes.begin();
  for (std::int32_t r = c.first_row[lane]; r < c.last_row[lane]; ++r) {
    const std::uint32_t columns = c.columns[r][lane];
    if (columns == 0) continue;
    if (next == boxes.end() || next->line != c.first_line[lane] + r / pattern.count ||
        next->box.sample != static_cast<std::uint32_t>(r % pattern.count) ||
        (next->box.first | next->box.last() << 16) != columns)
      return false;
    ++next;
  }
  const float numbers[] = {c.x1[lane], c.y1[lane], c.x2[lane], c.y2[lane], c.inverse[lane]};
  const float expected[] = {static_cast<float>(t.x[1] - t.x[0]), static_cast<float>(t.y[1] - t.y[0]),
                            static_cast<float>(t.x[2] - t.x[0]), static_cast<float>(t.y[2] - t.y[0]),
                            1.0f / static_cast<float>(area(t))};
  return next == boxes.end() && std::equal(numbers, numbers + 5, expected) &&
         (c.faces >> lane & 1) == (area(t) < 0 ? 1u : 0u);
}

struct Tally {
  int states[kStates] = {};
};

// All kernels, on batches that are consecutive or not.
void expect_right(const std::vector<Corners>& triangles, const ClassifyTask& task, std::uint32_t count,
                  shape::Random& random, Tally& tally) {
  std::vector<std::vector<UnsortedEdgeBox>> boxes;
  for (const Corners& t : triangles) boxes.push_back(plain_edge_boxes(t, task.width, task.height, task.pattern));
  Batch16 batch(triangles, random.whole(0, 1) == 1, random);
  for (const simd::InstructionSet set : simd::all_sets()) {
    const Classified classified = batch.classify(set, task, count);
    for (std::uint32_t lane = 0; lane < kBatchTriangles; ++lane) {
      const Corners& t = triangles[lane];
      const State state = state_of(classified, lane);
      const bool right = lane >= count
                             ? state == kDropped
                             : right_state(state, t, task, !boxes[lane].empty()) &&
                                   (state != kDecided || right_columns(classified, lane, t, task.pattern, boxes[lane]));
      ASSERT_TRUE(right) << simd::name_of(set) << ", lane " << lane << " of " << count << ", state " << state << ": "
                         << t.x[0] << ',' << t.y[0] << ' ' << t.x[1] << ',' << t.y[1] << ' ' << t.x[2] << ',' << t.y[2]
                         << " in " << task.width << " x " << task.height << " with " << task.pattern.count
                         << " samples";
      tally.states[state] += set == simd::InstructionSet::sse2 && lane < count;
    }
  }
}

// Where and how large: mostly in the picture or over its borders, corners often on samples or pixels' borders.
Corners random_triangle(shape::Random& random, const ClassifyTask& task) {
  const std::int32_t size = static_cast<std::int32_t>(std::exp2(random.real(2, 14.2)));
  const auto middle = [&](std::int32_t samples) {
    if (random.whole(0, 50) == 0) return random.whole(-8400000, 8400000);
    return random.whole(0, 4) ? random.whole(0, 256 * samples) : 256 * samples * random.whole(0, 1);
  };
  const std::int32_t x = middle(task.width), y = middle(task.height);
  const int kind = random.whole(0, 5);
  const auto snapped = [&](std::int32_t place) {
    return kind == 0 ? place / 256 * 256 + 128 : kind == 1 ? place / 128 * 128 : place;
  };
  Corners t;
  for (int k = 0; k < 3; ++k) {
    t.x[k] = snapped(x + random.whole(-size / 2, size / 2));
    t.y[k] = snapped(y + random.whole(-size / 2, size / 2));
  }
  switch (random.whole(0, 11)) {
    case 0: t.y[1] = t.y[0]; break;
    case 1: t.x[1] = t.x[0]; break;
    case 2:  // a sliver
      t.x[2] = (t.x[0] + t.x[1]) / 2 + random.whole(-6, 6);
      t.y[2] = (t.y[0] + t.y[1]) / 2 + random.whole(-6, 6);
      break;
    case 3:
      t.x[2] = t.x[0] + random.whole(-6, 6);
      t.y[2] = t.y[0] + random.whole(-6, 6);
      break;
    default: break;
  }
  return t;
}

TEST(Classify, TrianglesAsIn64Bits) {
  shape::Random random(70);
  Tally tally;
  constexpr std::int32_t kPictures[][2] = {{100, 80}, {100, 80}, {3, 2}, {7, 300}, {16384, 16384}};
  for (std::size_t trial = 0; trial < 25000; ++trial) {
    const auto& [width, height] = kPictures[trial % 5];
    const shape::SamplePattern& pattern = shape::sample_pattern(shape::kSampleCounts[trial / 5 % 5]);
    const ClassifyTask task{width, height, pattern, random.whole(0, 2) == 0, random.whole(0, 1) == 1};
    std::vector<Corners> triangles(kBatchTriangles);
    for (Corners& t : triangles) t = random_triangle(random, task);
    const std::uint32_t count = random.whole(0, 2) ? kBatchTriangles : static_cast<std::uint32_t>(random.whole(1, 15));
    expect_right(triangles, task, count, random, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.states[kDecided], 30000);
  EXPECT_GT(tally.states[kUndecided], 10000);
  EXPECT_GT(tally.states[kDropped], 20000);
}

// One 1/256 pixel about what is still small, and about what is thin.
TEST(Classify, TheBordersOfWhatIsDecided) {
  shape::Random random(71);
  Tally tally;
  int just_small = 0, just_large = 0, just_thin = 0, just_sure = 0;
  for (std::size_t trial = 0; trial < 1500; ++trial) {
    const ClassifyTask task{100, 80, shape::sample_pattern(shape::kSampleCounts[trial % 5]), false, false};
    std::vector<Corners> triangles(kBatchTriangles);
    for (Corners& t : triangles) {
      const std::int32_t x = random.whole(-9000, 17000), y = random.whole(-9000, 12000);
      if (random.whole(0, 1)) {
        const std::int32_t width = kSmall + random.whole(-1, 1),
                           height = random.whole(0, 1) ? kSmall + random.whole(-1, 1) : 3000;
        t = {{x, x + width, x + random.whole(-width, width)}, {y, y + random.whole(-height, height), y + height}};
        (small(t) ? just_small : just_large) += 1;
      } else {  // the side 5 high is thin where long is 4 far + 20 or less
        const std::int32_t far = random.whole(0, 2000), length = 4 * far + 20 + random.whole(-1, 1);
        t = {{x, x + length, x + far}, {y, y, y + 5}};
        (above_thin(t) > 0 ? just_sure : just_thin) += std::abs(above_thin(t)) <= 1;
      }
      if (random.whole(0, 1)) std::swap_ranges(t.x, t.x + 3, t.y);
    }
    expect_right(triangles, task, kBatchTriangles, random, tally);
    if (HasFatalFailure()) return;
  }
  for (const int count : {just_small, just_large, just_thin, just_sure}) EXPECT_GT(count, 500);
  EXPECT_GT(tally.states[kDecided], 2000);
  EXPECT_GT(tally.states[kUndecided], 2000);
}

// As high as any that is decided, from each place within a line on: its rows are on one line more than are whole in it.
TEST(Classify, TheHighest) {
  shape::Random random(72);
  Tally tally;
  constexpr std::int32_t kHalf = kSmall - 1;
  for (const std::uint32_t samples : shape::kSampleCounts) {
    const ClassifyTask task{20, 200, shape::sample_pattern(samples), false, false};
    for (std::int32_t top = 0; top < 256; top += kBatchTriangles) {
      std::vector<Corners> triangles(kBatchTriangles);
      for (std::int32_t k = 0; k < static_cast<std::int32_t>(kBatchTriangles); ++k) {
        const std::int32_t y = 2560 + top + k + kHalf;
        triangles[static_cast<std::size_t>(k)] = {{500, random.whole(1000, 4000), random.whole(1000, 4000)},
                                                  {y, y - kHalf, y + kHalf}};
      }
      expect_right(triangles, task, kBatchTriangles, random, tally);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(tally.states[kDecided], 1000);
}

}  // namespace
}  // namespace mars::raster
