// The arithmetic of a binary hypercube: node ids are bit strings, neighbours differ in one bit. Pure numbers,
// for machines of up to 2^30 nodes.
#pragma once

#include <bit>
#include <cstdint>

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

}  // namespace mars::topology
