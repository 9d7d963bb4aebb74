// Where a frame's triangles and edge boxes exceed a node's memory, its lines are drawn in several passes, in each of
// which every home draws a part of its lines and all nodes make the triangles of these parts again. How many passes
// there are follows from counts alone, before any memory is used.
#pragma once

#include <cstdint>
#include <span>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/raster/line_load.h"

namespace mars::group {

struct Pass {
  std::uint32_t number = 0;
  std::uint32_t count = 1;

  bool is_last() const { return number + 1 == count; }
};

// The lines of a home that are drawn in a pass. The parts for twice as many passes lie within these.
geometry::LineRange part_of(const geometry::LineRange& home, const Pass& pass);

// `wanted` has one entry a line of the picture: 1 where one of the homes draws it in the pass, else 0.
void mark_lines(std::span<const geometry::LineRange> homes, const Pass& pass, std::span<std::uint8_t> wanted);

// The triangles that one node made and that touch a sample, and their edge boxes.
struct MadeCounts {
  std::uint64_t triangles = 0;
  std::uint64_t edge_boxes = 0;
};

// Bytes that these take on their node in a single pass, sorted into their lines too. `travels`: some are sent to other
// nodes, as copies.
std::uint64_t own_bytes(const MadeCounts& made, bool travels);

// Whether these take more than half of a node's memory. Where no node's do, one pass fits if what comes from others
// fits the other half.
bool is_large(std::uint64_t own_bytes, std::uint64_t memory);

// Bytes of a pass besides triangles and edge boxes, in a picture of `lines` lines: the counting sorts' arrays, and the
// rounding of each piece of memory, of which each node of a group may send one.
std::uint64_t fixed_bytes(std::size_t lines, std::size_t nodes);

// A frame as a node of the group knows it when lines are mapped.
struct FrameLoad {
  collectives::Group group;
  std::span<const std::uint64_t> ebc;            // of all nodes (mapping.h)
  std::span<const geometry::LineRange> homes;    // of the group's nodes
  std::uint64_t large;                           // nodes of the group whose own triangles are (is_large)
  std::span<const raster::LineLoad> line_loads;  // of the node's own triangles
  std::uint64_t triangles;                       // of its own
  bool travels;                                  // some nodes of the group cannot read each other's memory
};

// A bound on the bytes that node `node` uses in any of `passes` passes.
std::uint64_t memory_for(const FrameLoad& load, int node, std::uint32_t passes);

// The least number of passes, a power of two, for which `memory` bytes suffice on node `node`. Throws Failure where
// they do not suffice for one line.
std::uint32_t passes_for(const FrameLoad& load, int node, std::uint64_t memory);

// Returns once all nodes of the group have come here; collective.
void wait_for_all(const collectives::Group& group);

// The number of passes that suffices on all nodes of the group, the same on each; collective. Nodes exchange their
// numbers only where one pass might not suffice for one of them, which all know from the sums.
std::uint32_t agree_on_passes(const FrameLoad& load, std::uint64_t memory);

}  // namespace mars::group
