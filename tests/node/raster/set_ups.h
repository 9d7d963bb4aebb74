// A patch set up by a node's own code, in memory of the test's.
#pragma once

#include <cstdint>
#include <vector>

#include "node/raster/setup.h"

namespace mars::raster {

struct Made {
  std::vector<geometry::Triangle> triangles;
  std::vector<UnsortedEdgeBox> boxes;  // the first first
  std::vector<LineLoad> line_loads;
  std::uint64_t touching = 0;
  std::uint64_t edge_boxes = 0;
  bool all_stored = false;
};

// Of one edge box.
inline LineLoad load_of(const UnsortedEdgeBox& unsorted) { return {1, unsorted.box.width()}; }

enum class Way { at_a_time, plainly };  // SetUp::add, SetUp::add_plainly

struct Picture {
  shape::Projection projection;
  std::int32_t width;
  std::int32_t height;
  std::uint32_t samples = 1;
  bool casting = false;  // as of SetUp
};

// `bytes` of memory. Fails the test where anything outside it is written.
Made set_up(simd::InstructionSet set, const Picture& picture, const shape::Surface& surface,
            const PatchIdentity& identity, Way way = Way::at_a_time, const std::vector<std::uint8_t>& wanted_lines = {},
            std::size_t bytes = 1 << 24);

}  // namespace mars::raster
