#include "host/render/walls/walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <vector>

#include "hal/failure/failure.h"
#include "host/render/walls/walls_text.h"

namespace mars::walls {
namespace {

// Work of 4 s, of which 1 is uneven, and then sums of 2 s; meanwhile storage takes 5 s.
double toy(Walls without) {
  const double work = without.has(Wall::compute) ? 0 : without.has(Wall::imbalance) ? 3 : 4;
  const double sum = without.has(Wall::sum) ? 0 : 2;
  return std::max(work + sum, without.has(Wall::storage) ? 0.0 : 5.0);
}

const Walls kThere{Wall::compute, Wall::imbalance, Wall::sum, Wall::storage};

TEST(Explained, TheGreatestGainBinds) {
  const auto without_storage = [](Walls without) { return toy(without.with({Wall::storage})); };
  const Explanation explanation = explain(without_storage, kThere);
  ASSERT_NE(explanation.binding(), nullptr);
  EXPECT_EQ(explanation.seconds, 6);
  EXPECT_EQ(explanation.binding()->wall, Wall::compute);
  EXPECT_EQ(explanation.binding()->without, 2);
  EXPECT_EQ(explanation.binding()->alone, 3);  // of even work
  EXPECT_EQ(explanation.next, Wall::sum);
  EXPECT_EQ(explanation.without_next, 0);
}

TEST(Explained, WhatIsUnevenCountsApartFromWork) {
  const auto uneven = [](Walls without) { return without.has(Wall::compute) ? 0.0 : without.has(Wall::frame) ? 1 : 4; };
  const Explanation explanation = explain(uneven, {Wall::compute, Wall::frame});
  EXPECT_EQ(explanation.binding()->wall, Wall::frame);
  EXPECT_EQ(explanation.binding()->alone, 3);
  EXPECT_EQ(explanation.next, Wall::compute);
  EXPECT_EQ(explanation.without_next, 0);
}

TEST(Explained, WhereNoneGainsTheLongestIsNamed) {
  const auto two = [](Walls without) {
    return std::max(without.has(Wall::storage) ? 0 : 5.0, without.has(Wall::host) ? 0 : 4.99);
  };
  const Explanation explanation = explain(two, {Wall::host, Wall::storage});
  EXPECT_EQ(explanation.binding()->wall, Wall::storage);
  EXPECT_EQ(explanation.binding()->alone, 5);
  EXPECT_EQ(explanation.binding()->without, 4.99);
  EXPECT_EQ(explanation.next, Wall::host);
  EXPECT_TRUE(
      table_of(explanation)
          .ends_with("\n  no gain is more than 2 %, so several walls bind together: the longest alone is first\n"));
}

// Work of 5 s, half of it uneven, and then files of 3 s: without work the rendering is the shortest, but work that is
// even gains less than files do.
TEST(Explained, TheTableShowsTheRule) {
  const auto uneven = [](Walls without) {
    const double even = 2.5, unevenly = (without.has(Wall::imbalance) ? 0 : 1) + (without.has(Wall::frame) ? 0 : 1.5);
    return (without.has(Wall::compute) ? 0 : even + unevenly) + (without.has(Wall::encoder) ? 0 : 3);
  };
  const std::string table = table_of(explain(uneven, {Wall::compute, Wall::imbalance, Wall::frame, Wall::encoder}));
  for (const char* row : {"encoder +3 +5 +3 +encoding", "compute +2.5 +3 +2.5 +work"})
    EXPECT_TRUE(std::regex_search(table, std::regex(row))) << table;
  EXPECT_NE(
      table.find("\n  the wall with the greatest gain binds; compute gains only what evenly divided work takes\n"),
      table.npos)
      << table;
  EXPECT_TRUE(table_of(explain(toy, {Wall::sum})).ends_with("\n  the wall with the greatest gain binds\n"));
}

TEST(Explained, WallsThatTakeNoTimeAreLeftOut) {
  const Explanation explanation = explain(toy, kThere.with({Wall::host}));
  EXPECT_TRUE(std::ranges::none_of(explanation.walls, [](const FoundWall& one) { return one.wall == Wall::host; }));
  EXPECT_EQ(explanation.walls.size(), 4u);
}

TEST(Explained, WhereNothingTakesTimeNothingBinds) {
  const Explanation explanation = explain([](Walls) { return 0.0; }, {});
  EXPECT_EQ(explanation.binding(), nullptr);
  EXPECT_EQ(line_of(explanation), "none");
}

TEST(Explained, TimesAreAskedForTogetherAndOnce) {
  std::vector<std::size_t> asked;
  std::set<unsigned long> known;
  const AllSecondsWithout all = [&](const std::vector<Walls>& several) {
    asked.push_back(several.size());
    std::vector<double> seconds;
    for (const Walls walls : several) {
      EXPECT_TRUE(known.insert(walls.number()).second) << walls.number();
      seconds.push_back(toy(walls));
    }
    return seconds;
  };
  EXPECT_EQ(table_of(explain(all, kThere)), table_of(explain(toy, kThere)));
  EXPECT_LE(asked.size(), 3u);
  EXPECT_GE(asked.front(), 8u);
}

TEST(Explained, IsReadAsItWasWritten) {
  const Explanation explanation = explain(toy, kThere), read = explanation_of(json_of(explanation));
  EXPECT_EQ(line_of(read), line_of(explanation));
  EXPECT_EQ(table_of(read), table_of(explanation));
  EXPECT_EQ(line_of(read), "imbalance 1 s; without it 5 s; then storage, without both 5 s");
  nlohmann::json wrong = json_of(explanation);
  wrong["walls"][0]["wall"] = "weather";
  EXPECT_THROW(explanation_of(wrong), Failure);
}

}  // namespace
}  // namespace mars::walls
