// Which nodes draw which inbetween.
#include "node/wire/protocol.h"

#include <gtest/gtest.h>

#include <vector>

namespace mars::wire {
namespace {

std::vector<std::int32_t> contributors(const Render& render) {
  std::vector<std::int32_t> nodes;
  for (std::uint32_t k = 0; k + 1 < render.frame_count; ++k)
    nodes.push_back(
        team_of_inbetween(render.first_inbetween + k, {render.group_first, render.group_count}, render.teams).first);
  return nodes;
}

TEST(Contributors, GoRoundTheGroupsNodes) {
  EXPECT_EQ(contributors({.interval = 3, .group_first = 4, .group_count = 3, .frame_count = 6, .first_inbetween = 0}),
            (std::vector<std::int32_t>{4, 5, 6, 4, 5}));
}

TEST(Contributors, GoOnWhereTheIntervalBeforeEnded) {
  EXPECT_EQ(contributors({.interval = 4, .group_first = 4, .group_count = 3, .frame_count = 3, .first_inbetween = 5}),
            (std::vector<std::int32_t>{6, 4}));
  EXPECT_EQ(contributors({.group_count = 2, .frame_count = 2, .first_inbetween = 1'000'000'000'001}),
            (std::vector<std::int32_t>{1}));
}

TEST(Contributors, GoByTheCycleOverTheWholeFilm) {
  const std::vector<std::int32_t> cycle{2, 0, 2};
  EXPECT_EQ(team_of_inbetween(0, {0, 3}, 0, cycle).first, 2);
  EXPECT_EQ(team_of_inbetween(4, {0, 3}, 0, cycle).first, 0);
  EXPECT_EQ(team_of_inbetween(1'000'000'000'001, {0, 3}, 0, cycle).first, 2);
}

TEST(Contributors, FormTeamsSideBySide) {
  const collectives::Group group{4, 5};
  EXPECT_EQ(team_of_inbetween(6, group, 2), (collectives::Group{4, 2}));
  EXPECT_EQ(team_of_inbetween(7, group, 2), (collectives::Group{6, 3}));
  EXPECT_EQ(team_of_inbetween(7, group, 1), group);
  EXPECT_EQ(own_team(5, group, 2), (collectives::Group{4, 2}));
  EXPECT_EQ(own_team(6, group, 2), (collectives::Group{6, 3}));
  EXPECT_EQ(own_team(7, group, 0), (collectives::Group{7, 1}));
}

TEST(Contributors, OfATeamTakeTurnsInWriting) {
  const collectives::Group group{4, 6};
  std::vector<std::int32_t> writers;
  for (std::uint64_t inbetween = 0; inbetween < 8; ++inbetween)
    writers.push_back(writer_of_inbetween(inbetween, group, 2, team_of_inbetween(inbetween, group, 2)));
  EXPECT_EQ(writers, (std::vector<std::int32_t>{4, 7, 5, 8, 6, 9, 4, 7}));
}

}  // namespace
}  // namespace mars::wire
