// Boxes of points, the pairs of a pixel, and points of layers on grids and back.
#include "node/shadow/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "tests/node/shadow/views.h"
#include "tests/node/shape/sample_counts.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shadow {
namespace {

using shape::Random;

GridBox random_box(Random& random, int reach, int most) {
  const int x = random.whole(-reach, reach), y = random.whole(-reach, reach);
  const auto low = static_cast<float>(random.real(-4, 4));
  return {x, x + random.whole(0, most), y, y + random.whole(0, most), low, low + static_cast<float>(random.real(0, 1))};
}

// Whether a caster in `box` comes nearer to the points of `points` than `far` steps, from any point of a light.
bool meets(const GridBox& box, const GridBox& points, double spread, double far) {
  const double height = double{box.high_z} - double{points.low_z};
  const double margin = spread * height + far;
  return height > 0 && box.low_x - margin <= points.high_x && box.high_x + margin >= points.low_x &&
         box.low_y - margin <= points.high_y && box.high_y + margin >= points.low_y;
}

TEST(BoxTree, FindsAllThatACasterMayBlockAndLittleElse) {
  Random random(61);
  std::size_t found_all = 0;
  for (const int count : {0, 1, 15, 16, 17, 300})
    for (int trial = 0; trial < 20; ++trial) {
      const int reach = 1 << random.whole(8, 29);
      std::vector<GridBox> boxes;
      BoxTree tree;
      tree.clear();
      for (int k = 0; k < count; ++k) {
        boxes.push_back(random_box(random, reach, reach / 8));
        tree.add(boxes.back());
      }
      tree.finish();
      EXPECT_EQ(tree.count(), boxes.size());
      for (int query = 0; query < 10; ++query) {
        const GridBox box = random_box(random, reach, reach / 4);
        const auto spread = static_cast<float>(random.whole(0, 1) ? random.real(0, 0.2) * reach : 0);
        for (const simd::InstructionSet set : simd::all_sets()) {
          std::vector<std::uint32_t> into;
          const auto found = tree.find(shadow_kernels(set), box, spread, into);
          const std::set<std::uint32_t> numbers(found.begin(), found.end());
          EXPECT_EQ(numbers.size(), found.size());
          for (std::uint32_t k = 0; k < boxes.size(); ++k) {
            if (meets(box, boxes[k], double{spread}, 0)) {
              ASSERT_TRUE(numbers.contains(k)) << simd::name_of(set);
            } else if (!meets(box, boxes[k], double{spread} * 1.001, 600)) {
              ASSERT_FALSE(numbers.contains(k)) << simd::name_of(set);
            }
          }
          if (!numbers.empty()) {
            EXPECT_TRUE(tree.any(shadow_kernels(set), box, spread));
          }
          found_all += numbers.size();
        }
      }
    }
  EXPECT_GT(found_all, 1000u);
}

TEST(Pairs, OfSamples) {
  EXPECT_EQ(pairs_of(0b1010, 1), 0b1010u);
  EXPECT_EQ(pairs_of(0b1010, 4), 0xf0f0u);
  EXPECT_EQ(pairs_of(0b1, 16), 0xffffu);
  EXPECT_EQ(pairs_of(0, 4), 0u);
  for (const std::uint32_t samples : shape::kSampleCounts) {
    EXPECT_EQ(pairs_a_sample(samples, false), 1u);
    EXPECT_EQ(pairs_a_sample(samples, true) * samples, kPairs);
    EXPECT_EQ(pairs_of((1u << samples) - 1, pairs_a_sample(samples, true)), 0xffffu);
  }
}

TEST(Pairs, EachSquareOfPixelsUsesEachPointEquallyOften) {
  for (std::uint32_t top = 0; top < 8; ++top)
    for (std::uint32_t left = 0; left < 8; ++left) {
      std::array<std::uint32_t, kLightPoints> uses{};
      for (std::uint32_t line = top; line < top + 4; ++line)
        for (std::uint32_t column = left; column < left + 4; ++column) {
          std::set<std::uint32_t> points;
          for (std::uint32_t pair = 0; pair < kPairs; ++pair) {
            const std::uint32_t point = point_of_pair(column, line, pair);
            ASSERT_LT(point, kLightPoints);
            points.insert(point);
            ++uses[point];
          }
          EXPECT_EQ(points.size(), kPairs) << "a pixel uses a point twice";
        }
      for (const std::uint32_t n : uses) ASSERT_EQ(n, 4u) << left << ' ' << top;
    }
}

TEST(Pairs, VectorsHaveEachPairOfASquareOnce) {
  for (const std::uint32_t samples : shape::kSampleCounts)
    for (const bool has_size : {false, true}) {
      const PairVectors vectors(shape::sample_pattern(samples), has_size);
      std::set<std::tuple<int, int, int>> seen;
      for (std::uint32_t point = 0; point < (has_size ? kLightPoints : 1); ++point)
        for (std::uint32_t v = 0; v < vectors.vectors(); ++v)
          for (std::size_t k = 0; k < kPointLanes; ++k) {
            const Lane& lane = vectors.lanes(point, v).lane[k];
            const LanePlaces& place = vectors.lanes(point, v).place;
            const shape::SamplePattern& pattern = shape::sample_pattern(samples);
            EXPECT_EQ(place.x[k] * 256, static_cast<float>(256 * lane.column + pattern.x[lane.sample]));
            EXPECT_EQ(place.y[k] * 256, static_cast<float>(256 * lane.line + pattern.y[lane.sample]));
            EXPECT_LT(lane.column, kTile);
            EXPECT_LT(lane.line, kTile);
            EXPECT_TRUE(seen.emplace(lane.column, lane.line, lane.pair).second);
            EXPECT_EQ(lane.sample, lane.pair / pairs_a_sample(samples, has_size));
            if (has_size) {
              EXPECT_EQ(point_of_pair(lane.column, lane.line, lane.pair), point);
            }
          }
      EXPECT_EQ(seen.size(), kTile * kTile * (has_size ? kPairs : samples));
    }
}

// Of a layer with holes, in a picture whose squares are not whole: each sample that matters has one point, where
// put_points says, and what is noted comes to its bit.
TEST(Points, OfALayerAreThoseThatMatterAndAreNotedAtTheirPairs) {
  constexpr std::uint32_t kWidth = 21, kFirst = 3, kLast = 22;
  Random random(62);
  for (const std::uint32_t samples : {1u, 4u, 16u})
    for (const bool has_size : {false, true})
      for (const Casting casting : {Casting::still, Casting::moving}) {
        const shape::SamplePattern& pattern = shape::sample_pattern(samples);
        const auto light = random_light(random, wire::LightKind::directional, has_size ? 0.1 : 0);
        const LightViews views = light_views(light, kPicture);
        std::vector<float> depth(std::size_t{kWidth} * samples * (kLast - kFirst));
        std::vector<wire::StillPairs> pairs(std::size_t{2} * kWidth * (kLast - kFirst));
        std::vector<std::uint16_t> moved(pairs.size());
        for (float& d : depth) d = random.whole(0, 4) ? static_cast<float>(random.real(0.05, 1)) : 0;
        for (auto& p : pairs)
          p = {static_cast<std::uint16_t>(random.bits()), static_cast<std::uint16_t>(random.bits() & random.bits())};
        for (auto& m : moved) m = static_cast<std::uint16_t>(random.bits() & random.bits() & random.bits());
        Layer layer;
        layer.begin(kWidth, {kFirst, kLast});
        for (std::uint32_t k = 0; k < kLast - kFirst; ++k)
          if (k != 5)
            layer.lines[k] = {&depth[std::size_t{k} * samples * kWidth], kWidth, &pairs[std::size_t{2} * k * kWidth],
                              &moved[std::size_t{2} * k * kWidth]};
        layer.count_all_tiles();
        const auto pairs_before = pairs;
        const auto moved_before = moved;
        const PairVectors vectors(shape::sample_pattern(samples), has_size);
        std::size_t expected = 0, active = 0;
        for (std::uint32_t point = 0; point < views.points; ++point) {
          const PointSource source{
              shadow_kernels(simd::best_instruction_set("")), views.frame, pattern, vectors, 1, point};
          Points points;
          points.clear();
          for (const std::uint32_t tile : layer.tiles)
            add_points(source, std::span(views.views).subspan(point, 1), layer, {tile, TilePart::kAll}, {&points, 1});
          points.finish();
          active += points.count();
          for (std::size_t v = 0; v < points.tree().count(); ++v)
            points.vectors()[v].blocked = points.vectors()[v].active;
          points.note(source, casting);
        }
        for (std::uint32_t k = 0; k < kLast - kFirst; ++k)
          for (std::uint32_t x = 0; x < kWidth; ++x)
            for (std::uint32_t l = 0; l < 2; ++l) {
              const std::size_t at = std::size_t{2} * k * kWidth + l * kWidth + x;
              std::uint32_t some = 0;
              const std::uint32_t each = pairs_a_sample(samples, has_size);
              for (std::uint32_t pair = 0; pair < samples * each; ++pair)
                if (depth[(std::size_t{k} * samples + pair / each) * kWidth + x] > 0) some |= 1u << pair;
              some &= pairs_before[at].lit & ~(pairs_before[at].blocked | moved_before[at]);
              if (k == 5 || l == 0) some = 0;
              expected += static_cast<std::size_t>(std::popcount(some));
              const bool still = casting == Casting::still;
              ASSERT_EQ(pairs[at].blocked, pairs_before[at].blocked | (still ? some : 0));
              ASSERT_EQ(moved[at], moved_before[at] | (still ? 0 : some));
              ASSERT_EQ(pairs[at].lit, pairs_before[at].lit);
            }
        EXPECT_EQ(active, expected);
        EXPECT_GT(expected, 50u);
      }
}

}  // namespace
}  // namespace mars::shadow
