// Whom a group's inbetweens go to, by how its nodes are getting on.
#include "host/render/farm/shares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "node/wire/protocol.h"

namespace mars::farm {
namespace {

using Cycle = std::vector<std::int32_t>;

// By node.
std::map<int, int> counts(const std::vector<Standing>& nodes, std::uint64_t first, std::size_t count) {
  const Cycle cycle = share_out(nodes, first, count);
  std::map<int, int> drawn;
  for (std::size_t k = 0; k < count; ++k)
    ++drawn[wire::team_of_inbetween(first + k, {0, static_cast<std::int32_t>(nodes.size())}, 0, cycle).first];
  return drawn;
}

TEST(Shares, AreTurnsWhileAllKeepUp) {
  EXPECT_TRUE(share_out(std::vector<Standing>(3), 5, 9).empty());
  EXPECT_TRUE(share_out(std::vector<Standing>{{3, 1}, {9, 1}, {12, 1}}, 5, 9).empty()) << "some are ahead of others";
}

TEST(Shares, OfASlowNodeAreFewer) {
  EXPECT_EQ(counts({{0, 1}, {0, 1}, {0, 2}, {0, 1}}, 0, 28), (std::map<int, int>{{0, 8}, {1, 8}, {2, 4}, {3, 8}}));
  EXPECT_EQ(counts({{0, 1}, {0, 25}}, 0, 26), (std::map<int, int>{{0, 25}, {1, 1}}));
  EXPECT_EQ(counts({{0, 1}, {0, 1}, {0, 2}, {0, 1}}, 0, 3), (std::map<int, int>{{0, 1}, {1, 1}, {3, 1}}))
      << "where others do it sooner it gets none";
}

TEST(Shares, OfNodesThatAreAsFastComeInTurns) {
  const Cycle cycle = share_out(std::vector<Standing>{{0, 1}, {0, 8}, {0, 1}, {0, 1}}, 0, 6);
  EXPECT_EQ(cycle, (Cycle{0, 2, 3, 0, 2, 3}));
  EXPECT_EQ(counts({{0, 1}, {0, 8}, {0, 1}, {0, 1}}, 2, 1), (std::map<int, int>{{2, 1}}));
  EXPECT_EQ(counts({{0, 1}, {0, 8}, {0, 1}, {0, 1}}, 1'000'003, 1), (std::map<int, int>{{3, 1}}))
      << "short intervals do not favour the first";
}

TEST(Shares, CountWhatNodesHaveLeft) {
  EXPECT_EQ(counts({{13, 1}, {2, 1}}, 0, 8), (std::map<int, int>{{1, 8}})) << "one is far behind";
  EXPECT_EQ(counts({{1, 2}, {0, 1}}, 0, 8), (std::map<int, int>{{0, 2}, {1, 6}}));
}

TEST(Shares, GiveAForgottenNodeOne) {
  EXPECT_EQ(counts({{0, 1}, {0, 25, true}, {0, 1}}, 7, 5), (std::map<int, int>{{0, 2}, {1, 1}, {2, 2}}));
}

TEST(Shares, StayWithinWhatACommandCanSay) {
  EXPECT_EQ(share_out(std::vector<Standing>{{0, 1}, {0, 2}}, 3, 100'000).size(), wire::kMostCycle);
}

TEST(Shares, ANewPortionIsDueBeforeTheFastestHasNothingLeft) {
  EXPECT_FALSE(runs_short(std::vector<Standing>{{8, 1}, {8, 1}}));
  EXPECT_TRUE(runs_short(std::vector<Standing>{{8, 1}, {3, 1}}));
  EXPECT_FALSE(runs_short(std::vector<Standing>{{4, 1}, {1, 2.5}})) << "a slow one has enough with few";
  EXPECT_FALSE(runs_short(std::vector<Standing>{{4, 1}, {0, 25}})) << "or with none";
  EXPECT_TRUE(runs_short(std::vector<Standing>{{0, 25}, {0, 9}})) << "where all are slow";
}

}  // namespace
}  // namespace mars::farm
