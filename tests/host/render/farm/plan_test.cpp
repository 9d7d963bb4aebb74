#include "host/render/farm/plan.h"

#include <gtest/gtest.h>

#include <cstring>
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

TEST(Plan, LongIntervalsMayBeCutIntoTasksOfAboutEqualLength) {
  const EmptyFilm film({7, 2});
  const Plan plan = make_plan(film.view(), {.frames = {0, 1, 2, 3, 4, 5, 6, 7, 8}, .most_frames = 3}, 4);
  ASSERT_EQ(plan.tasks.size(), 4u);
  EXPECT_EQ(plan.tasks[0].frames, (Frames{0, 1}));
  EXPECT_EQ(plan.tasks[1].frames, (Frames{2, 3}));
  EXPECT_EQ(plan.tasks[2].frames, (Frames{4, 5, 6}));
  EXPECT_EQ(plan.tasks[2].interval, 0u);
  EXPECT_EQ(plan.tasks[2].first_inbetween, 2u);
  EXPECT_EQ(plan.tasks[3].frames, (Frames{7, 8}));
  EXPECT_EQ(plan.tasks[3].interval, 1u);
  EXPECT_EQ(plan.tasks[3].first_inbetween, 4u);
  EXPECT_EQ(plan.keyframes(), 4u);
  EXPECT_EQ(plan.inbetweens(), 5u);
}

TEST(Plan, NodesOfAGroupFormTeamsOfSharersAtLeast) {
  Plan plan;
  EXPECT_EQ(plan.teams_of({0, 7}), 7);
  plan.sharers = 3;
  EXPECT_EQ(plan.teams_of({0, 7}), 2);
  EXPECT_EQ(plan.teams_of({4, 2}), 1) << "of all nodes";
  plan.sharers = 0;
  EXPECT_EQ(plan.teams_of({0, 7}), 7);
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

wire::Render head_of(const std::vector<std::byte>& message) {
  wire::Render render;
  std::memcpy(&render, message.data(), sizeof render);
  return render;
}

TEST(Plan, ATasksFirstPortionNamesAllFramesAndLaterOnesTheirOwn) {
  const Task task{3, {10, 11, 12, 14, 15, 16}, 100};
  const auto first = render_command(task, {0, 2}, {4, 3}, {2}), then = render_command(task, {2, 1, {2}}, {4, 3}, {2}),
             last = render_command(task, {3, 2}, {4, 3}, {2});
  EXPECT_EQ(head_of(first).frame_count, 6u);
  EXPECT_EQ(head_of(first).drawn, 3u) << "and the keyframe";
  EXPECT_EQ(head_of(first).goes_on, 0);
  EXPECT_EQ(head_of(first).listed, 1);
  EXPECT_EQ(first.size(), sizeof(wire::Render) + 6 * sizeof(std::uint32_t));
  EXPECT_EQ(head_of(then).first_frame, 14u);
  EXPECT_EQ(head_of(then).first_inbetween, 102u);
  EXPECT_EQ(head_of(then).goes_on, 1);
  EXPECT_EQ(head_of(then).cycle, 1);
  EXPECT_EQ(then.size(), sizeof(wire::Render) + sizeof(std::int32_t));
  EXPECT_EQ(head_of(last).frame_count, 2u);
  EXPECT_EQ(head_of(last).drawn, 2u);
  EXPECT_EQ(last.size(), sizeof(wire::Render)) << "its frames follow each other";
}

TEST(Plan, AWholeTaskIsTold) {
  const Task task{3, {10, 11, 12}, 100};
  const auto all = render_command(task, {4, 3}, {2});
  EXPECT_EQ(all.size(), 48u) << "as long as ever: simulated times count it";
  EXPECT_EQ(head_of(all).drawn, 3u);
  EXPECT_EQ(head_of(all).cycle, 0);
}

TEST(Plan, InbetweensGoRoundTheGroup) {
  Frames counts(3);
  for (std::uint64_t inbetween = 0; inbetween < 300; ++inbetween)
    ++counts.at(static_cast<std::size_t>(wire::team_of_inbetween(inbetween, {0, 3}, 0).first));
  EXPECT_EQ(counts, (Frames{100, 100, 100}));
}

TEST(Groups, OfAMillionNodesHaveAllOfThem) {
  constexpr int kNodes = 1 << 20;
  const std::vector<collectives::Group> groups = make_groups(kNodes, kNodes, kNodes);
  EXPECT_EQ(groups.back(), (collectives::Group{kNodes - 1, 1}));
}

}  // namespace
}  // namespace mars::farm
