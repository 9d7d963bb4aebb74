// Which node draws which inbetween.
#include "node/wire/protocol.h"

#include <gtest/gtest.h>

#include <vector>

namespace mars::wire {
namespace {

std::vector<std::int32_t> contributors(const Render& render) {
  std::vector<std::int32_t> nodes;
  for (std::uint32_t k = 0; k + 1 < render.frame_count; ++k)
    nodes.push_back(render.group_first + contributor_of_inbetween(render.first_inbetween + k, render.group_count));
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
  EXPECT_EQ(contributor_of_inbetween(0, 3, cycle), 2);
  EXPECT_EQ(contributor_of_inbetween(4, 3, cycle), 0);
  EXPECT_EQ(contributor_of_inbetween(1'000'000'000'001, 3, cycle), 2);
}

}  // namespace
}  // namespace mars::wire
