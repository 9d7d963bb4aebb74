// CZB: the z that an interval's stationary parts left, on the lines that its inbetweens may touch. Each machine has
// one for each group: the group's nodes there write their home lines to it, and all of them read it.
//
// Home lines are written in a keyframe, after the group's sum of EBC: no node leaves that before all have come to it
// and so have finished the inbetweens of the interval before. Inbetweens read, after DepthExchange::complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/messages/private_memory.h"
#include "hal/messages/shared_memory.h"
#include "node/geometry/line_range.h"

namespace mars::raster {

class Czb {
 public:
  // Of a picture's size, of the caller's group, one of `groups` that the nodes, each on its machine, form side by side.
  // Pages are used as lines are written. Collective over a machine's nodes. Throws Failure where memory is short.
  Czb(std::span<const std::int32_t> machines, int groups, std::int32_t width, std::int32_t height);

  // 1 / w a sample, 0 where nothing stands; line after line.
  std::span<float> lines(const geometry::LineRange& lines);

  // The first node of `node`'s group on its machine, which collects there what comes from other machines.
  int head_of(int node) const { return heads_[static_cast<std::size_t>(node)]; }

 private:
  std::size_t width_;
  std::vector<std::int32_t> heads_;
  std::optional<messages::SharedMemory> shared_;  // all that nodes of this machine share
  messages::PrivateMemory own_;                   // where the group has no other node here
  float* depth_;
};

}  // namespace mars::raster
