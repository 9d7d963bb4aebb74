#include "host/render/farm/plan.h"

#include <gtest/gtest.h>

#include <numeric>

#include "node/wire/protocol.h"
#include "tests/host/render/farm/empty_film.h"

namespace mars::farm {
namespace {

using Frames = std::vector<std::uint32_t>;

TEST(Plan, CutsFramesIntoTasksOfOneInterval) {
  const EmptyFilm film({4, 4, 2});
  const Plan plan = make_plan(film.view(), {{1, 2, 3, 7, 8, 9}}, 3);
  ASSERT_EQ(plan.tasks.size(), 3u);
  EXPECT_EQ(plan.tasks[0].frames, (Frames{1, 2, 3}));
  EXPECT_EQ(plan.tasks[1].frames, (Frames{7})) << "an interval may be asked for in part";
  EXPECT_EQ(plan.tasks[2].frames, (Frames{8, 9})) << "the last is short";
  EXPECT_EQ(plan.tasks[2].interval, 2u);
  EXPECT_EQ(plan.tasks[2].first_inbetween, 2u) << "of the inbetweens drawn, not of the film's";
  EXPECT_EQ(plan.keyframes(), 3u);
  EXPECT_EQ(plan.inbetweens(), 3u);
  EXPECT_EQ(plan.frames(), 6u);
}

TEST(Plan, WithoutCoherenceEveryFrameIsATask) {
  const EmptyFilm film({4, 4});
  const Plan plan = make_plan(film.view(), {{0, 1, 5}, false}, 1);
  ASSERT_EQ(plan.tasks.size(), 3u);
  EXPECT_EQ(plan.inbetweens(), 0u);
  EXPECT_EQ(plan.tasks[2].interval, 1u);
}

TEST(Plan, OneFrame) {
  const EmptyFilm film({4, 4});
  const Plan plan = make_plan(film.view(), {{6}}, 8);
  ASSERT_EQ(plan.tasks.size(), 1u);
  EXPECT_EQ(plan.tasks[0].frames, (Frames{6}));
  EXPECT_EQ(plan.groups, (std::vector<collectives::Group>{{0, 8}}));
}

TEST(Plan, GroupsCoverTheNodesSideBySide) {
  for (const int nodes : {1, 2, 5, 8})
    for (const int groups : {1, 2, 3, 100}) {
      const std::vector<collectives::Group> made = make_groups(nodes, groups, 1);
      EXPECT_EQ(made.size(), static_cast<std::size_t>(std::min(nodes, groups)))
          << "no more than nodes, though than tasks";
      int next = 0;
      for (const collectives::Group& group : made) {
        EXPECT_EQ(group.first, next);
        EXPECT_GE(group.count, 1);
        next += group.count;
      }
      EXPECT_EQ(next, nodes);
    }
}

TEST(Plan, WithoutAWishAGroupForEveryFourTasks) {
  EXPECT_EQ(make_groups(8, 0, 0).size(), 1u);
  EXPECT_EQ(make_groups(8, 0, 7).size(), 1u);
  EXPECT_EQ(make_groups(8, 0, 8).size(), 2u);
  EXPECT_EQ(make_groups(8, 0, 1000).size(), 8u);
}

TEST(Plan, InbetweensGoRoundTheGroup) {
  Frames counts(3);
  for (std::uint64_t inbetween = 0; inbetween < 300; ++inbetween)
    ++counts.at(static_cast<std::size_t>(wire::contributor_of_inbetween(inbetween, 3)));
  EXPECT_EQ(counts, (Frames{100, 100, 100}));
}

}  // namespace
}  // namespace mars::farm
