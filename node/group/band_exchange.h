// A keyframe whose file its group writes (wire/frame_writer.h): edges of bands go to the nodes that compose these, what
// inbetweens need of bands to each machine that has contributors, once (relay.h), and all bands to the node that writes
// the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/pending_messages.h"
#include "node/group/relay.h"
#include "node/raster/neighbours.h"
#include "node/wire/frame_writer.h"

namespace mars::group {

// The same on all nodes of the group.
struct BandNeeds {
  collectives::Group group;
  std::span<const geometry::LineRange> homes;  // of the group's nodes
  std::span<const std::uint8_t> contributes;   // 1: the node draws inbetweens; of all the group's nodes
  int writer;                                  // the node that writes the keyframe
};

class BandExchange {
 public:
  BandExchange(const raster::Neighbours& neighbours, const wire::FrameWriter& writer);
  BandExchange(const raster::Neighbours&&, auto&&...) = delete;

  // Of the group, of which each node has pasted its home lines, so that the writer can finish its bands.
  void exchange_edges(const BandNeeds& needs, wire::FrameWriter& writer);
  // Collective over the group, once each node's bands are finished. A contributor returns when the interval's
  // background is there, the writer when it has the keyframe.
  void complete(const BandNeeds& needs, wire::FrameWriter& writer);

 private:
  class Plan;
  class Background;

  void exchange_edges(const Plan& plan, wire::FrameWriter& writer);
  void send_picture(const Plan& plan, wire::FrameWriter& writer);
  void collect_picture(const Plan& plan, wire::FrameWriter& writer);
  void send(long type, std::span<const std::byte> message, int to);
  std::span<const std::byte> receive(long type, const Plan& plan);

  const raster::Neighbours& neighbours_;
  Relay relay_;
  PendingMessages pending_;
  std::vector<std::uint8_t> collectors_;  // Plan's
  std::vector<std::byte> message_;        // that was received
};

}  // namespace mars::group
