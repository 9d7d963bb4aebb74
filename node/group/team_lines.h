// How the nodes of a team divide the lines of an inbetween that they draw together: evenly by what lines cost, as far
// as boxes round moving parts say. So all find the same ranges without a message, before anything is diced, and each
// node dices only what may touch its lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/geometry/scene.h"
#include "node/geometry/segment_place.h"

namespace mars::group {

// Of files that the team writes; none: a band is a line.
struct FileBands {
  std::uint32_t lines = 1;       // of a band, all of which one node draws
  std::uint64_t line_bytes = 0;  // pixels that are encoded where moving parts touch the band
};

class TeamLines {
 public:
  // `lines`: of a picture. `most`: nodes of a team.
  TeamLines(std::size_t lines, std::size_t most);

  // The lines of each of `nodes` nodes, in order; they tile the picture. `touched`: lines that moving parts or their
  // shadows may touch in the interval.
  std::span<const geometry::LineRange> divide(const geometry::Scene& scene, const geometry::ShapeBoxes& boxes,
                                              const geometry::LineRange& touched, std::size_t nodes,
                                              const FileBands& bands);
  // As it was divided last.
  std::span<const geometry::LineRange> ranges() const { return ranges_; }
  // Points that were put on the picture for that.
  std::uint64_t points() const { return points_; }

 private:
  void add_segment(const geometry::Scene& scene, std::uint32_t segment, const geometry::ShapeBoxes& boxes,
                   std::size_t nodes);
  void add(const geometry::PictureBounds& bounds, double pieces, const geometry::Scene& scene);
  void add_up_bands(const FileBands& bands);

  std::vector<std::uint64_t> steps_;   // of the weight, from each line to the next; modulo 2^64
  std::vector<std::uint64_t> totals_;  // of bands' weights, running
  std::vector<geometry::LineRange> ranges_;
  geometry::SegmentPlace place_;  // of the segment that is added
  std::uint64_t points_ = 0;
};

}  // namespace mars::group
