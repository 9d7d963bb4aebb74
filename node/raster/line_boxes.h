// Edge boxes in their lines, by counting sort.
#pragma once

#include <cstdint>
#include <span>

#include "node/geometry/line_range.h"
#include "node/geometry/triangle.h"
#include "node/raster/arena.h"
#include "node/raster/edge_box.h"

namespace mars::raster {

// One node's part of a frame's triangles, in which its edge boxes count from `triangles`.
struct Polygons {
  const geometry::Triangle* triangles;
  std::span<const UnsortedEdgeBox> stationary;
  std::span<const UnsortedEdgeBox> moving;
};

// Edge boxes of lines [lines.first, lines.last): line by line the stationary ones, then the moving ones.
struct LineBoxes {
  geometry::LineRange lines;
  std::span<const EdgeBox> boxes;
  std::span<const std::uint64_t> end;             // of each line's boxes
  std::span<const std::uint64_t> stationary_end;  // of each line's stationary boxes

  std::span<const EdgeBox> of(std::uint32_t line) const;
  std::span<const EdgeBox> stationary(std::uint32_t line) const;
  std::span<const EdgeBox> moving(std::uint32_t line) const;
  // How many are on the lines `some`.
  std::uint64_t count(const geometry::LineRange& some) const;

 private:
  std::uint64_t begin(std::uint32_t line) const { return line == lines.first ? 0 : end[line - lines.first - 1]; }
};

// All edge boxes of some lines: one part of each node that had them sorted, with these lines among its own. Triangles
// of all parts count from the same place.
using LineParts = std::span<const LineBoxes>;

bool any_stationary(LineParts parts, const geometry::LineRange& lines);

// Puts edge boxes into their lines: a counting sort whose offsets are the running totals of their counts. Senders may
// be added in any order; edge boxes of other lines are left out.
class LineFiller {
 public:
  // `totals`: one more than there are lines; totals[i] + a constant boxes are on the first i of them. Boxes will name
  // triangles by their distance from `first`. Takes its arrays from `arena`.
  LineFiller(const geometry::LineRange& lines, std::span<const std::uint64_t> totals, const geometry::Triangle* first,
             Arena& arena);

  // Of all that were counted.
  std::uint64_t box_count() const { return boxes_.size(); }
  void add(const Polygons& polygons);
  // check()s that the boxes are exactly those that were counted.
  LineBoxes finish() const;

 private:
  geometry::LineRange lines_;
  const geometry::Triangle* first_;
  std::span<EdgeBox> boxes_;
  std::span<std::uint64_t> end_;
  std::span<std::uint64_t> stationary_;  // each line's from its begin, growing
  std::span<std::uint64_t> moving_;      // and from its end, falling
};

}  // namespace mars::raster
