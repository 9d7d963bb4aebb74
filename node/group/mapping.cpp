#include "node/group/mapping.h"

#include <algorithm>
#include <cstddef>

namespace mars::group {
namespace {

std::uint64_t load(std::span<const std::uint64_t> totals, const geometry::LineRange& range) {
  return totals[range.last] - totals[range.first];
}

std::uint64_t greatest_load(std::span<const std::uint64_t> totals, std::span<const geometry::LineRange> ranges) {
  std::uint64_t greatest = 0;
  for (const geometry::LineRange& range : ranges) greatest = std::max(greatest, load(totals, range));
  return greatest;
}

// Fills ranges so that none exceeds `bound`, each as long as it can be; whether all lines found a place.
bool probe(std::span<const std::uint64_t> totals, std::uint64_t bound, std::span<geometry::LineRange> ranges) {
  const auto lines = static_cast<std::uint32_t>(totals.size() - 1);
  std::uint32_t first = 0;
  for (geometry::LineRange& range : ranges) {
    const auto beyond = std::upper_bound(totals.begin() + first, totals.end(), totals[first] + bound);
    const auto last = static_cast<std::uint32_t>(beyond - totals.begin()) - 1;
    range = {first, last};
    first = last;
  }
  return first == lines;
}

}  // namespace

void map_greedy(std::span<const std::uint64_t> totals, std::span<geometry::LineRange> ranges) {
  const auto lines = static_cast<std::uint32_t>(totals.size() - 1);
  const std::uint64_t total = totals[lines];
  const std::uint64_t nodes = ranges.size();
  std::uint32_t i = 0;
  std::uint32_t first = 0;
  for (std::uint64_t node = 0; node + 1 < nodes; ++node) {
    // The thesis's End is total * (node + 1) / nodes; everything is multiplied by nodes to stay whole.
    const std::uint64_t end = total * (node + 1);
    while (i < lines && totals[i] * nodes < end) ++i;
    const bool nearer_before = i > first && totals[i] * nodes - end > end - totals[i - 1] * nodes;
    const std::uint32_t last = nearer_before ? i - 1 : i;
    ranges[node] = {first, last};
    first = last;
  }
  ranges.back() = {first, lines};
}

void map_optimal(std::span<const std::uint64_t> totals, std::span<geometry::LineRange> ranges) {
  const std::uint64_t total = totals.back();
  const std::uint64_t nodes = ranges.size();
  std::uint64_t heaviest = 0;
  for (std::size_t i = 1; i < totals.size(); ++i) heaviest = std::max(heaviest, totals[i] - totals[i - 1]);
  std::uint64_t low = std::max(heaviest, (total + nodes - 1) / nodes);
  map_greedy(totals, ranges);
  std::uint64_t high = std::max(low, greatest_load(totals, ranges));
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (probe(totals, middle, ranges))
      high = middle;
    else
      low = middle + 1;
  }
  probe(totals, high, ranges);
}

void map_lines(wire::Mapping mapping, std::span<const std::uint64_t> totals, std::span<geometry::LineRange> ranges) {
  if (mapping == wire::Mapping::greedy)
    map_greedy(totals, ranges);
  else
    map_optimal(totals, ranges);
}

double load_ratio(std::span<const std::uint64_t> totals, std::span<const geometry::LineRange> ranges) {
  if (totals.back() == 0) return 1.0;
  const double average = static_cast<double>(totals.back()) / static_cast<double>(ranges.size());
  return static_cast<double>(greatest_load(totals, ranges)) / average;
}

}  // namespace mars::group
