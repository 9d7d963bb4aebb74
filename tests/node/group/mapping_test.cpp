// Mapping of scanlines to nodes: greedy against figure 4.7 word for word, optimal and cost against every partition
// there is.
#include "node/group/mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "node/wire/film_parts.h"
#include "tests/node/shape/patches.h"

namespace mars::group {
namespace {

using geometry::LineRange;
using Totals = std::vector<std::uint64_t>;

Totals prefix_sum(const std::vector<std::uint64_t>& weights) {
  Totals ebc{0};
  for (const std::uint64_t weight : weights) ebc.push_back(ebc.back() + weight);
  return ebc;
}

// Loads as pictures have them: empty lines, about equal ones, and now and then one that outweighs all.
Totals random_totals(shape::Random& random, int lines) {
  std::vector<std::uint64_t> weights;
  const int zeros = random.whole(0, 3), most = random.whole(1, 30);
  for (int i = 0; i < lines; ++i)
    weights.push_back(random.whole(0, 3) < zeros ? 0 : static_cast<std::uint64_t>(random.whole(0, most)));
  if (random.whole(0, 3) == 0) weights[static_cast<std::size_t>(random.whole(0, lines - 1))] = 1000;
  return prefix_sum(weights);
}

// Figure 4.7 as printed, with everything times allnodes, so that Step's remainder is not lost. As printed it
// reads EBC(-1) where EBC(0) reaches End, that is where there is no edge box at all.
std::vector<LineRange> figure_4_7(const Totals& ebc, std::uint64_t allnodes) {
  const auto EBC = [&](std::int64_t i) {
    return static_cast<std::int64_t>(ebc.at(static_cast<std::size_t>(i)) * allnodes);
  };
  const auto lines = static_cast<std::uint32_t>(ebc.size() - 1);
  const auto step = static_cast<std::int64_t>(ebc.back());
  std::int64_t end = step, i = 0;
  std::vector<LineRange> ranges;
  std::uint32_t first = 0;
  for (std::uint64_t node = 0; node + 1 < allnodes; ++node) {
    while (EBC(i) < end) i = i + 1;
    const std::int64_t last = i > 0 && EBC(i) - end > end - EBC(i - 1) ? i - 1 : i;
    ranges.push_back({first, static_cast<std::uint32_t>(last)});
    first = ranges.back().last;
    end = end + step;
  }
  ranges.push_back({first, lines});
  return ranges;
}

// The smallest possible greatest load of lines [first, lines) on `nodes` nodes, by trying everything.
std::uint64_t best_of_all(const Totals& ebc, std::size_t first, std::size_t nodes) {
  const std::size_t lines = ebc.size() - 1;
  if (nodes == 1) return ebc[lines] - ebc[first];
  std::uint64_t best = ~std::uint64_t{0};
  for (std::size_t last = first; last <= lines; ++last)
    best = std::min(best, std::max(ebc[last] - ebc[first], best_of_all(ebc, last, nodes - 1)));
  return best;
}

std::uint64_t greatest(const Totals& ebc, const std::vector<LineRange>& ranges) {
  std::uint64_t most = 0;
  for (const LineRange& range : ranges) most = std::max(most, ebc[range.last] - ebc[range.first]);
  return most;
}

std::vector<LineRange> mapped(wire::Mapping mapping, const Totals& ebc, std::size_t nodes) {
  std::vector<LineRange> ranges(nodes, LineRange{77, 7});
  map_lines(mapping, ebc, ranges);
  return ranges;
}

void expect_tiled(const std::vector<LineRange>& ranges, std::size_t lines) {
  std::uint32_t next = 0;
  for (const LineRange& range : ranges) {
    EXPECT_EQ(range.first, next);
    EXPECT_LE(range.first, range.last);
    next = range.last;
  }
  EXPECT_EQ(next, lines);
}

TEST(Mapping, GreedyIsFigure4_7) {
  shape::Random random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    const Totals ebc = random_totals(random, random.whole(1, 40));
    const auto nodes = static_cast<std::size_t>(random.whole(1, 48));
    const auto ranges = mapped(wire::Mapping::greedy, ebc, nodes);
    ASSERT_EQ(ranges, figure_4_7(ebc, nodes)) << "trial " << trial;
    expect_tiled(ranges, ebc.size() - 1);
  }
}

TEST(Mapping, OptimalIsTheBestOfAllPartitions) {
  shape::Random random(2);
  for (int trial = 0; trial < 3000; ++trial) {
    const Totals ebc = random_totals(random, random.whole(1, 9));
    const auto nodes = static_cast<std::size_t>(random.whole(1, 5));
    const auto ranges = mapped(wire::Mapping::optimal, ebc, nodes);
    expect_tiled(ranges, ebc.size() - 1);
    ASSERT_EQ(greatest(ebc, ranges), best_of_all(ebc, 0, nodes)) << "trial " << trial;
  }
}

// What lines cost, word for word.
Totals random_costs(shape::Random& random, int lines) {
  std::vector<std::uint64_t> costs;
  for (int line = 0; line < lines; ++line) {
    const auto boxes = static_cast<std::uint64_t>(random.whole(0, 2) ? random.whole(0, 300) : 0);
    const std::uint64_t samples = boxes * static_cast<std::uint64_t>(random.whole(1, 500));
    costs.push_back(kBoxCost * boxes + kSampleCost * samples);
    EXPECT_EQ(line_cost({boxes, samples}), costs.back());
  }
  return prefix_sum(costs);
}

TEST(Mapping, CostIsTheBestOfAllPartitions) {
  shape::Random random(4);
  for (int trial = 0; trial < 3000; ++trial) {
    const Totals costs = random_costs(random, random.whole(1, 9));
    const auto nodes = static_cast<std::size_t>(random.whole(1, 5));
    const auto ranges = mapped(wire::Mapping::cost, costs, nodes);
    expect_tiled(ranges, costs.size() - 1);
    ASSERT_EQ(greatest(costs, ranges), best_of_all(costs, 0, nodes)) << "trial " << trial;
  }
}

TEST(Mapping, OptimalIsNeverWorseThanGreedy) {
  shape::Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const Totals ebc = random_totals(random, random.whole(1, 2000));
    const auto nodes = static_cast<std::size_t>(random.whole(1, 64));
    const auto optimal = mapped(wire::Mapping::optimal, ebc, nodes);
    expect_tiled(optimal, ebc.size() - 1);
    EXPECT_LE(greatest(ebc, optimal), greatest(ebc, mapped(wire::Mapping::greedy, ebc, nodes)));
  }
}

TEST(Mapping, GreedyKeepsTheRemainder) {
  // Step = 11 / 4 = 2.75; cut to 2 the last node would get 5 of 11. The tie at 5.5 goes to the later line.
  const Totals ebc = prefix_sum(std::vector<std::uint64_t>(11, 1));
  const std::vector<LineRange> expected{{0, 3}, {3, 6}, {6, 8}, {8, 11}};
  EXPECT_EQ(mapped(wire::Mapping::greedy, ebc, 4), expected);
}

TEST(Mapping, OneHeavyLineLeavesNodesWithoutAny) {
  const Totals ebc = prefix_sum({0, 0, 100, 0});
  for (const wire::Mapping mapping : {wire::Mapping::greedy, wire::Mapping::optimal, wire::Mapping::cost}) {
    const auto ranges = mapped(mapping, ebc, 6);
    expect_tiled(ranges, 4);
    EXPECT_EQ(greatest(ebc, ranges), 100u);
  }
}

TEST(Mapping, NothingToDraw) {
  const Totals ebc = prefix_sum({0, 0, 0});
  for (const wire::Mapping mapping : {wire::Mapping::greedy, wire::Mapping::optimal, wire::Mapping::cost})
    expect_tiled(mapped(mapping, ebc, 4), 3);
  EXPECT_EQ(load_ratio(ebc, mapped(wire::Mapping::greedy, ebc, 4)), 1.0);
}

// As many boxes and samples on each of the most lines as a LineLoad holds.
TEST(Mapping, LargestCostsStayWithin64Bits) {
  const std::uint64_t most = line_cost({raster::LineLoad::kMostBoxes, raster::LineLoad::kMostSamples});
  EXPECT_EQ(most, kBoxCost * raster::LineLoad::kMostBoxes + kSampleCost * raster::LineLoad::kMostSamples);
  const Totals costs = prefix_sum(std::vector<std::uint64_t>(wire::kMaxSide, most));
  EXPECT_EQ(costs.back() / wire::kMaxSide, most);
  EXPECT_EQ(mapped(wire::Mapping::cost, costs, 1024)[1023], (LineRange{wire::kMaxSide - 16, wire::kMaxSide}));
}

// Totals of the largest film: 2^32 patches of 2^17 triangles on 1024 nodes stay within 64 bits.
TEST(Mapping, LargeTotals) {
  const std::uint64_t most = std::uint64_t{1} << 49;
  const Totals ebc = prefix_sum({most, most, most, most});
  const std::vector<LineRange> expected{{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  EXPECT_EQ(mapped(wire::Mapping::greedy, ebc, 4), expected);
  EXPECT_EQ(mapped(wire::Mapping::optimal, ebc, 4), expected);
  const auto many = mapped(wire::Mapping::greedy, ebc, 1024);
  EXPECT_EQ(many, figure_4_7(ebc, 1024));
}

TEST(Mapping, LoadRatio) {
  const Totals ebc = prefix_sum({1, 2, 3, 4, 0});
  const std::vector<LineRange> ranges{{0, 3}, {3, 3}, {3, 4}, {4, 5}};
  EXPECT_DOUBLE_EQ(load_ratio(ebc, ranges), 6 / 2.5);
  const std::vector<LineRange> all{{0, 5}};
  EXPECT_DOUBLE_EQ(load_ratio(ebc, all), 1.0);
}

}  // namespace
}  // namespace mars::group
