// Bands of an inbetween that a team of nodes draws and encodes together (wire/frame_writer.h): each node sends its own
// to the node that writes the file. Nodes get ahead of each other by whole frames, so bands may come before they are
// needed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/group/outbox.h"

namespace mars::group {

class TeamBands {
 public:
  // `group`: the caller's.
  explicit TeamBands(const collectives::Group& group);

  // The caller is of this team until the next call. All of a team's nodes call.
  void join(const collectives::Group& team) { team_ = team; }
  void send(std::uint32_t frame, std::span<const std::byte> bands, int writer);
  // The node's bands of the frame, valid until the next call; waits for them. None: Stop has come, here or there.
  std::optional<std::span<const std::byte>> receive(std::uint32_t frame, int from, Outbox& outbox);
  // When the caller draws no more: what is on the way between nodes of the team is received, whoever stopped where.
  void finish();

 private:
  using Message = std::vector<std::byte>;
  struct Sent {
    Message message;
    long id = -1;  // -1: nothing on the way
  };

  std::deque<Message>& came_from(int node) { return came_[static_cast<std::size_t>(node - group_.first)]; }
  void receive_probed();

  const collectives::Group group_;
  collectives::Group team_{0, 0};
  std::array<Sent, 2> sent_;
  std::size_t next_ = 0;                   // of these
  std::vector<std::deque<Message>> came_;  // by node of the group
  Message taken_;
};

}  // namespace mars::group
