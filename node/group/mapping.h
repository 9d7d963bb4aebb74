// The mapping of scanlines to the nodes of a group: contiguous ranges of about equal loads, from the lines'
// prefix-summed weights. These are edge boxes, so that the sums are EBC (thesis figure 4.7), or costs.
#pragma once

#include <cstdint>
#include <span>

#include "node/geometry/line_range.h"
#include "node/raster/line_load.h"
#include "node/wire/protocol.h"

namespace mars::group {

// What a line costs to draw: ns for a box and for a sample with AVX-512, as `mars bench lines` measures them
// (docs/measuring.md), and for ten bytes that are kept of it for inbetweens and sent
// (cluster/platforms/reference.json). All nodes take the same, whatever their instruction set, so that they map alike.
inline constexpr std::uint64_t kBoxCost = 7;
inline constexpr std::uint64_t kSampleCost = 2;
inline constexpr std::uint64_t kTenStillBytesCost = 6;
constexpr std::uint64_t line_cost(const raster::LineLoad& load, std::uint64_t still_bytes = 0) {
  return kBoxCost * load.boxes() + kSampleCost * load.samples() + kTenStillBytesCost * still_bytes / 10;
}

// `totals`: lines + 1 running totals, totals[0] = 0 and totals[i] = the weight of lines [0, i).
// `ranges`: as many as the group has nodes; set to tile [0, lines) in order.
//
// greedy: the thesis's heuristic; each range but the last ends at the line whose running total is nearest to
// its share.
void map_greedy(std::span<const std::uint64_t> totals, std::span<geometry::LineRange> ranges);
// optimal: the smallest possible greatest load, by probing with bisection (Pinar & Aykanat, "Fast optimal
// load balancing algorithms for 1D partitioning", 2004): O(lines + P log lines log total).
void map_optimal(std::span<const std::uint64_t> totals, std::span<geometry::LineRange> ranges);

// greedy by map_greedy, the others by map_optimal; GroupSums::weights has the totals that belong to each.
void map_lines(wire::Mapping mapping, std::span<const std::uint64_t> totals, std::span<geometry::LineRange> ranges);

// Greatest load over average load; 1 where there is no load.
double load_ratio(std::span<const std::uint64_t> totals, std::span<const geometry::LineRange> ranges);

}  // namespace mars::group
