// What each node of a group has for all machines with contributors (collectors.h) goes round these machines once: their
// heads form a ring in the order of nodes, and a head passes each piece on to the next before it uses the piece itself,
// until all have it. So each machine receives everything once and sends no more than that, however unevenly nodes have
// it; pieces are small, so that they are on all links of the ring at the same time (a pipelined ring all-gather;
// Thakur, Rabenseifner, Gropp 2005).
//
// Within a machine nodes share memory: a node that has written there what the machine needs of it sends an empty
// message to the head, and the head, once it has all, one to each contributor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/messages/private_memory.h"
#include "node/group/collectors.h"

namespace mars::group {

// What a node sends to, and what comes from, other machines.
class Relayed {
 public:
  virtual ~Relayed() = default;

  // Whether the node has a part of it.
  virtual bool has_part(int node) const = 0;
  // Whether anything of the caller's part is left; writes the next of it into a piece, and returns its bytes.
  virtual bool is_left() const = 0;
  virtual std::size_t fill(std::span<std::byte> piece) = 0;
  // What `owner` wrote into a piece. Throws Failure where that makes no sense.
  virtual void take(int owner, std::span<const std::byte> piece) = 0;
};

class Relay {
 public:
  // Messages have that `type`; fill() writes about wire::kRelayPiece bytes, or `most` where that is more. `what` they
  // carry, for failures.
  Relay(long type, std::size_t most, const char* what);

  // Collective over the group. The head of a machine with contributors returns when it has all, and so do these.
  void exchange(const Collectors& collectors, Relayed& relayed);

 private:
  // Before what fill() writes.
  struct Head {
    std::int32_t owner;
    std::uint32_t last;  // 1: the owner has no more
  };

  // Of what a head receives: some await a piece, in others lie pieces that are being passed on.
  static constexpr std::size_t kAwaiting = 4;
  static constexpr std::size_t kReceiving = 2 * kAwaiting;
  static constexpr std::size_t kSending = 4;

  // A piece in hand, and the message that has yet to leave it or come to it.
  struct Buffer {
    long message = kNone;
    std::span<std::byte> bytes{};
  };
  static constexpr long kNone = -1;

  class Ring;

  bool expect_parts(const Ring& ring, const Relayed& relayed);
  void send_part(const Ring& ring, Relayed& relayed);
  bool send_piece(int to, Relayed& relayed);
  bool has_come();
  void receive_piece(const Ring& ring, Relayed& relayed);
  void note_whole(const Ring& ring, int owner);
  void post(Buffer& buffer);
  void finish(bool has_received);
  static void wait(Buffer& buffer);

  const long type_;
  const char* const what_;
  messages::PrivateMemory memory_;
  std::vector<Buffer> sending_, receiving_;
  std::size_t next_sent_ = 0, next_received_ = 0;  // counted on and on
  std::size_t parts_left_ = 0;                     // of others
  std::vector<std::uint8_t> is_whole_;             // the part; by node of the group
  std::vector<int> heads_after_;                   // in the ring; by node of the group
};

}  // namespace mars::group
