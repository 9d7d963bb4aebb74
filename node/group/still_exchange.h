// What stands still, for the nodes that draw inbetweens: after a keyframe each machine that has such nodes, the
// contributors, gets what inbetweens may change of the lines that they may touch (raster/still_lines.h), once.
//
// The group's nodes on a machine write their home lines there. The first of them, its head, receives the lines of other
// machines and an empty message from each node of its own that has written, and then notifies the machine's
// contributors. Lines that are depths alone travel in one message, with groups each line, in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/pending_messages.h"
#include "node/raster/still_lines.h"
#include "node/raster/neighbours.h"

namespace mars::group {

// The same on all nodes of the group.
struct StillNeeds {
  collectives::Group group;
  std::span<const geometry::LineRange> homes;  // of the group's nodes
  std::span<const std::uint8_t> contributes;   // 1: the node draws inbetweens; of all the group's nodes
};

class StillExchange {
 public:
  // `one_each`: lines have groups.
  StillExchange(const raster::Neighbours& neighbours, bool one_each, std::size_t height);

  // Collective over the group, which has written its home lines to `still`. A contributor returns when all of its lines
  // are there.
  void complete(const StillNeeds& needs, raster::StillLines& still);

 private:
  class Plan;

  void send_home_lines(const Plan& plan, raster::StillLines& still);
  void pack(const geometry::LineRange& lines, const raster::StillLines& still);
  void send_lines(const geometry::LineRange& lines, int to, const raster::StillLines& still);
  std::size_t messages_of(const geometry::LineRange& lines) const { return one_each_ ? lines.count() : 1; }
  void collect_lines(const Plan& plan, raster::StillLines& still);
  void receive_message(const Plan& plan, raster::StillLines& still);
  void notify_contributors(const Plan& plan) const;

  const raster::Neighbours& neighbours_;
  bool one_each_;  // a message has one line
  PendingMessages pending_;
  std::vector<std::uint8_t> collectors_;  // Plan's
  std::vector<std::byte> packed_;         // home lines, one after the other, as they are sent
  std::vector<std::byte> line_;           // that was received
};

}  // namespace mars::group
