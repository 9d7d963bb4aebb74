// What each rank did of a frame, from which fit.py replays it at other costs.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/tables/machine1992/work.h"

namespace mars::machine1992 {

// Bytes of pixels that an inbetween takes by the part of the MFB that is sent.
struct MovingBytes {
  std::uint64_t whole;   // all of it
  std::uint64_t lines;   // from the first to the last line where something was drawn
  std::uint64_t box;     // in those lines, from the first to the last column where something was drawn
  std::uint64_t pixels;  // what was drawn alone
  bool operator==(const MovingBytes&) const = default;
};

struct NodeRecord {
  std::uint32_t frame = 0;
  bool keyframe = false;
  WorkCounts lists;                   // before the EBC are summed
  std::vector<std::uint64_t> sent;    // bytes of edge boxes to each node; of a keyframe
  WorkCounts lines;                   // after that
  std::vector<std::uint64_t> strips;  // bytes of each to the host, in order
  std::uint64_t depths = 0;           // bytes of its own part of the CZB
  MovingBytes moving{};               // of an inbetween
  bool operator==(const NodeRecord&) const = default;
};

}  // namespace mars::machine1992
