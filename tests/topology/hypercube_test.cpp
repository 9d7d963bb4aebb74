// The identities of hypercubes, exhaustively to dimension 7.
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "topology/hypercube.h"

namespace mars::topology {
namespace {

constexpr int kDimensions = 7;

int bits_that_differ(int a, int b) {
  int bits = 0;
  for (int d = 0; d < 31; ++d) bits += (a >> d & 1) != (b >> d & 1);
  return bits;
}

TEST(Hypercube, DimensionIsTheSmallestThatHoldsAllNodes) {
  EXPECT_EQ(dimension(1), 0);
  for (int nodes = 2; nodes <= 1000; ++nodes) {
    EXPECT_GE(1 << dimension(nodes), nodes);
    EXPECT_LT(1 << (dimension(nodes) - 1), nodes);
  }
}

TEST(Hypercube, GrayCodeIsARingThroughAllNodes) {
  for (int d = 1; d <= kDimensions; ++d) {
    const int nodes = 1 << d;
    std::set<int> seen;
    for (int n = 0; n < nodes; ++n) {
      EXPECT_LT(gray(n), nodes);
      seen.insert(gray(n));
      EXPECT_EQ(bits_that_differ(gray(n), gray((n + 1) % nodes)), 1);
      EXPECT_EQ(inverse_gray(gray(n)), n);
      EXPECT_EQ(gray(inverse_gray(n)), n);
    }
    EXPECT_EQ(static_cast<int>(seen.size()), nodes);
  }
}

TEST(Hypercube, NeighboursAreAtDistanceOne) {
  for (int node = 0; node < 1 << kDimensions; ++node) {
    for (int d = 0; d < kDimensions; ++d) {
      EXPECT_EQ(distance(node, neighbour(node, d)), 1);
      EXPECT_EQ(neighbour(neighbour(node, d), d), node);
    }
  }
}

TEST(Hypercube, RoutesAreShortestAndCrossDimensionsUpwards) {
  for (int from = 0; from < 1 << kDimensions; ++from) {
    for (int to = 0; to < 1 << kDimensions; ++to) {
      ASSERT_EQ(distance(from, to), bits_that_differ(from, to));
      const std::vector<int> nodes = route(from, to);
      ASSERT_EQ(nodes.front(), from);
      ASSERT_EQ(nodes.back(), to);
      ASSERT_EQ(static_cast<int>(nodes.size()), distance(from, to) + 1);
      int crossed = 0;
      for (std::size_t i = 1; i < nodes.size(); ++i) {
        const int link = nodes[i - 1] ^ nodes[i];
        ASSERT_EQ(distance(nodes[i - 1], nodes[i]), 1);
        ASSERT_GT(link, crossed);
        crossed = link;
      }
    }
  }
}

TEST(Hypercube, SubCubesListTheirMembers) {
  const int nodes = 1 << kDimensions;
  for (int free = 0; free < nodes; ++free) {
    for (const int base : {0, 5, 77, nodes - 1}) {
      const SubCube cube{base, free};
      std::vector<int> expected;
      for (int node = 0; node < nodes; ++node) {
        if (cube.contains(node)) expected.push_back(node);
      }
      ASSERT_EQ(static_cast<int>(expected.size()), cube.size());
      ASSERT_EQ(members(cube), expected);
      ASSERT_TRUE(cube.contains(base));
    }
  }
}

}  // namespace
}  // namespace mars::topology
