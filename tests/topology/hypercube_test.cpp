// The identities of hypercubes, exhaustively to dimension 7.
#include <set>

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

TEST(Hypercube, NeighboursDifferInOneBit) {
  for (int node = 0; node < 1 << kDimensions; ++node) {
    for (int d = 0; d < kDimensions; ++d) {
      EXPECT_EQ(bits_that_differ(node, neighbour(node, d)), 1);
      EXPECT_EQ(neighbour(neighbour(node, d), d), node);
    }
  }
}

}  // namespace
}  // namespace mars::topology
