// CZB for the nodes that draw inbetweens: after a keyframe each machine that has such nodes, the contributors, gets the
// lines that inbetweens may touch, once.
//
// The group's nodes on a machine write their home lines to its CZB. The first of them, its head, receives there the
// lines of other machines and an empty message from each node of its own that has written, and then notifies the
// machine's contributors.
#pragma once

#include <cstdint>
#include <span>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/pending_messages.h"
#include "node/raster/czb.h"
#include "node/raster/neighbours.h"

namespace mars::group {

// The same on all nodes of the group.
struct DepthNeeds {
  collectives::Group group;
  std::span<const geometry::LineRange> homes;  // of the group's nodes
  geometry::LineRange lines;                   // that inbetweens may touch
  std::span<const std::uint8_t> contributes;   // 1: the node draws inbetweens; of all the group's nodes
};

class DepthExchange {
 public:
  explicit DepthExchange(const raster::Neighbours& neighbours) : neighbours_(neighbours) {}

  // Collective over the group, which has written its home lines to `czb`. A contributor returns when all needed lines
  // are there.
  void complete(const DepthNeeds& needs, raster::Czb& czb);

 private:
  class Plan;

  void send_home_lines(const Plan& plan, raster::Czb& czb);
  void collect_lines(const Plan& plan, raster::Czb& czb);
  void notify_contributors(const Plan& plan) const;

  const raster::Neighbours& neighbours_;
  PendingMessages pending_;
};

}  // namespace mars::group
