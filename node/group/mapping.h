// The mapping of scanlines to the nodes of a group: contiguous ranges of about equal numbers of edge boxes, from the
// prefix-summed EBC (thesis figure 4.7).
#pragma once

#include <cstdint>
#include <span>

#include "node/geometry/line_range.h"
#include "node/wire/protocol.h"

namespace mars::group {

// `ebc`: lines + 1 running totals, ebc[0] = 0 and ebc[i] = edge boxes on lines [0, i).
// `ranges`: as many as the group has nodes; set to tile [0, lines) in order.
//
// greedy: the thesis's heuristic; each range but the last ends at the line whose running total is nearest to
// its share.
void map_greedy(std::span<const std::uint64_t> ebc, std::span<geometry::LineRange> ranges);
// optimal: the smallest possible greatest load, by probing with bisection (Pinar & Aykanat, "Fast optimal
// load balancing algorithms for 1D partitioning", 2004): O(lines + P log lines log total).
void map_optimal(std::span<const std::uint64_t> ebc, std::span<geometry::LineRange> ranges);

void map_lines(wire::Mapping mapping, std::span<const std::uint64_t> ebc, std::span<geometry::LineRange> ranges);

// Greatest load over average load; 1 where there is no load.
double load_ratio(std::span<const std::uint64_t> ebc, std::span<const geometry::LineRange> ranges);

}  // namespace mars::group
