// What stands still, for the nodes that draw inbetweens: after a keyframe each machine that has such nodes, the
// contributors, gets what inbetweens may change of the lines that they may touch (raster/still_lines.h), once
// (relay.h). The group's nodes on a machine write their home lines there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/relay.h"
#include "node/raster/neighbours.h"
#include "node/raster/still_lines.h"

namespace mars::group {

// The same on all nodes of the group.
struct StillNeeds {
  collectives::Group group;
  std::span<const geometry::LineRange> homes;  // of the group's nodes
  std::span<const std::uint8_t> contributes;   // 1: the node draws inbetweens; of all the group's nodes
};

class StillExchange {
 public:
  StillExchange(const raster::Neighbours& neighbours, const raster::StillLines& still);
  StillExchange(const raster::Neighbours&&, auto&&...) = delete;

  // Collective over the group, which has written its home lines to `still`. A contributor returns when all of its lines
  // are there.
  void complete(const StillNeeds& needs, raster::StillLines& still);

 private:
  class Lines;

  const raster::Neighbours& neighbours_;
  Relay relay_;
  std::vector<std::uint8_t> collectors_;  // Collectors'
};

}  // namespace mars::group
