// The arithmetic of a binary hypercube: node ids are bit strings, neighbours differ in one bit. Pure numbers,
// for machines of up to 2^30 nodes; where messages really travel is the backend's affair.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace mars::topology {

// The smallest d with 2^d >= nodes; nodes >= 1.
constexpr int dimension(int nodes) { return std::bit_width(static_cast<std::uint32_t>(nodes - 1)); }

// The Gray code of n: gray(n) and gray(n + 1) are neighbours, and so are the last and the first of 2^d.
constexpr int gray(int n) { return n ^ (n >> 1); }

// The n whose Gray code is `code`.
constexpr int inverse_gray(int code) {
  int n = 0;
  for (; code != 0; code >>= 1) n ^= code;
  return n;
}

// The node across dimension d.
constexpr int neighbour(int node, int d) { return node ^ (1 << d); }

// Links between two nodes: the bits in which they differ.
constexpr int distance(int a, int b) { return std::popcount(static_cast<std::uint32_t>(a ^ b)); }

// The next node on the e-cube route from `at` to `to`, which crosses the lowest differing dimension first and
// for that cannot deadlock; `to` itself when there.
constexpr int next_on_route(int at, int to) {
  const int differing = at ^ to;
  return at ^ (differing & -differing);
}

// The nodes of the e-cube route, both ends included.
std::vector<int> route(int from, int to);

// The nodes that agree with `base` in every dimension outside `free_dimensions` (a set of bits).
struct SubCube {
  int base = 0;
  int free_dimensions = 0;

  constexpr int size() const { return 1 << std::popcount(static_cast<std::uint32_t>(free_dimensions)); }
  constexpr bool contains(int node) const { return ((node ^ base) & ~free_dimensions) == 0; }
  // Member k of 0..size()-1 in ascending order of node id; bits of k go to the free dimensions, lowest first.
  constexpr int member(int k) const;
};

constexpr int SubCube::member(int k) const {
  int node = base & ~free_dimensions;
  for (int left = free_dimensions; left != 0; left &= left - 1, k >>= 1) {
    if (k & 1) node |= left & -left;
  }
  return node;
}

// The node ids of `cube`, ascending.
std::vector<int> members(const SubCube& cube);

}  // namespace mars::topology
