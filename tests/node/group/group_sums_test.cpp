// The sums of a group on the threads backend against those of its nodes' loads, and what becomes of lines that exceed
// what one number counts.
#include "node/group/group_sums.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"
#include "node/group/mapping.h"
#include "tests/node/shape/patches.h"

namespace mars::group {
namespace {

using raster::LineLoad;
using Loads = std::vector<std::vector<LineLoad>>;  // of each node, by line

// `visit` on each node with the sums of all.
void add_up(const Loads& loads, const std::function<void(const GroupSums& sums)>& visit) {
  const auto nodes = static_cast<int>(loads.size());
  threads::run_threads(
      nodes, [] {},
      [&] {
        const auto& own = loads[static_cast<std::size_t>(mynode())];
        GroupSums sums(own.size());
        const std::uint64_t boxes =
            std::accumulate(own.begin(), own.end(), std::uint64_t{0},
                            [](std::uint64_t sum, const LineLoad& load) { return sum + load.boxes(); });
        sums.add_up({0, nodes}, {own, boxes, mynode() % 2 == 0});
        visit(sums);
      });
}

TEST(LineLoad, CountsBoxesAndSamplesInOneNumber) {
  LineLoad load(2, 700);
  load += LineLoad(1, 50);
  EXPECT_EQ(load.boxes(), 3u);
  EXPECT_EQ(load.samples(), 750u);
  EXPECT_EQ(load, LineLoad::of_packed(load.packed()));
  const LineLoad most(LineLoad::kMostBoxes, LineLoad::kMostSamples);
  EXPECT_EQ(most.packed(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(most.boxes(), LineLoad::kMostBoxes);
  EXPECT_EQ(most.samples(), LineLoad::kMostSamples);
}

TEST(GroupSums, AreTheSumsOfAllNodes) {
  shape::Random random(7);
  for (const int nodes : {1, 2, 3, 5, 8}) {
    Loads loads(static_cast<std::size_t>(nodes));
    constexpr std::size_t kLines = 50;
    std::vector<std::uint64_t> boxes(kLines + 1), costs(kLines + 1), samples(kLines);
    for (auto& own : loads)
      for (std::size_t line = 0; line < kLines; ++line) {
        const auto count = static_cast<std::uint64_t>(random.whole(0, 1'000'000));
        own.emplace_back(count, 3 * count);
        boxes[line + 1] += count;
        samples[line] += 3 * count;
        costs[line + 1] += kBoxCost * count + kSampleCost * 3 * count;
      }
    std::partial_sum(boxes.begin(), boxes.end(), boxes.begin());
    std::partial_sum(costs.begin(), costs.end(), costs.begin());
    add_up(loads, [&](const GroupSums& sums) {
      EXPECT_TRUE(std::ranges::equal(sums.ebc(), boxes));
      EXPECT_TRUE(std::ranges::equal(sums.weights(wire::Mapping::greedy), boxes));
      EXPECT_TRUE(std::ranges::equal(sums.weights(wire::Mapping::optimal), boxes));
      EXPECT_TRUE(std::ranges::equal(sums.weights(wire::Mapping::cost), costs));
      EXPECT_EQ(sums.samples_on({10, 20}), std::accumulate(&samples[10], &samples[20], std::uint64_t{0}));
      EXPECT_EQ(sums.large(), static_cast<std::uint64_t>((nodes + 1) / 2));
    });
  }
}

TEST(GroupSums, CountTheMostThatALineHolds) {
  const LineLoad half(LineLoad::kMostBoxes / 2, LineLoad::kMostSamples / 2), rest(1, 1);
  add_up({{half, {}}, {half, {}}, {rest, {}}}, [](const GroupSums& sums) {
    EXPECT_EQ(sums.ebc().back(), LineLoad::kMostBoxes);
    EXPECT_EQ(sums.samples_on({0, 1}), LineLoad::kMostSamples);
  });
}

TEST(GroupSums, FailWhereALineHoldsMore) {
  const LineLoad boxes(LineLoad::kMostBoxes, 0), samples(1 << 23, LineLoad::kMostSamples), one(1, 1);
  for (const Loads& loads : {Loads{{one, boxes}, {one, one}}, Loads{{one, samples}, {one, one}},
                             Loads{{boxes, boxes}, {boxes, boxes}, {one, one}}}) {
    try {
      add_up(loads, [](const GroupSums&) {});
      FAIL() << "more than a line's number holds";
    } catch (const std::exception& failure) {
      const std::string text = failure.what();
      EXPECT_NE(text.find("a line has more than 268435455 edge boxes"), std::string::npos) << text;
      EXPECT_NE(text.find("dice the film more coarsely"), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace mars::group
