#include "host/render/walls/even.h"

#include <gtest/gtest.h>

namespace mars::walls {
namespace {

TEST(EvenOut, NodesWithoutInbetweensHelp) {
  const std::vector<Pace> paces = even_out({{1, 6}, {1, 0}}, {{0, 2}});
  EXPECT_DOUBLE_EQ(paces[0].inbetweens, 0.5);
  EXPECT_DOUBLE_EQ(paces[1].inbetweens, 1);
  EXPECT_DOUBLE_EQ(paces[0].keyframes, 1);
}

TEST(EvenOut, GroupsWithoutTasksHelp) {
  const std::vector<Pace> paces = even_out({{2, 4}, {0, 0}}, {{0, 1}, {1, 1}});
  EXPECT_DOUBLE_EQ(paces[0].keyframes, 0.5);
  EXPECT_DOUBLE_EQ(paces[0].inbetweens, 0.5);
  EXPECT_DOUBLE_EQ(paces[1].inbetweens, 1);
}

TEST(EvenOut, NothingStaysNothing) {
  for (const Pace& pace : even_out({{0, 0}, {0, 0}}, {{0, 2}})) {
    EXPECT_EQ(pace.keyframes, 1);
    EXPECT_EQ(pace.inbetweens, 1);
  }
}

}  // namespace
}  // namespace mars::walls
