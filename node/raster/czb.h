// CZB: the z that an interval's stationary parts left, on the lines that its inbetweens may touch. Each machine has
// one for each group: the group's nodes there write their home lines to it, and all of them read it.
//
// Home lines are written in a keyframe, after the group's sum of EBC: no node leaves that before all have come to it
// and so have finished the inbetweens of the interval before. Inbetweens read, after DepthExchange::complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "node/geometry/line_range.h"
#include "node/raster/neighbours.h"

namespace mars::raster {

class Czb {
 public:
  // Of a picture's size, of the caller's group. Pages are used as lines are written. Collective over a machine's nodes.
  // Throws Failure where memory is short.
  Czb(const Neighbours& neighbours, std::int32_t width, std::int32_t height);

  // 1 / w a sample, 0 where nothing stands; line after line.
  std::span<float> lines(const geometry::LineRange& lines);

 private:
  std::size_t width_;
  NeighboursMemory memory_;
  float* depth_;
};

}  // namespace mars::raster
