#include "node/group/relay.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "node/wire/commands.h"
#include "node/wire/still_plan.h"

namespace mars::group {

// The heads of machines with contributors, in the order in which the caller passes pieces on.
class Relay::Ring {
 public:
  // `after`: to be used.
  Ring(const Collectors& nodes, std::vector<int>& after) : nodes_(nodes), after_(after) {
    const int count = nodes.last() - nodes.first();
    after.assign(static_cast<std::size_t>(count), static_cast<int>(kNone));
    for (int step = 2 * count, head = static_cast<int>(kNone); step-- > 0;) {
      const int node = nodes.first() + step % count;
      after[nodes.index(node)] = head;
      if (nodes.collects(node)) head = node;
    }
    next_ = after_of(nodes.self());
  }

  const Collectors& nodes() const { return nodes_; }
  bool is_head() const { return nodes_.collects(nodes_.self()); }
  // To which the caller's own pieces go first; none where no other machine collects.
  int entry() const { return entry_of(nodes_.self()); }
  // Whether the caller, a head, passes pieces of `owner` on to the next; else they have been everywhere.
  bool passes_on(int owner) const { return next_ != nodes_.head_of(owner) && next_ != entry_of(owner); }
  int next() const { return next_; }

 private:
  int entry_of(int owner) const {
    const int entry = after_of(nodes_.head_of(owner));
    return entry == nodes_.head_of(owner) ? static_cast<int>(kNone) : entry;
  }
  // The first head after `node`, which may be the node itself; kNone where there is none.
  int after_of(int node) const { return after_[nodes_.index(node)]; }

  const Collectors& nodes_;
  const std::vector<int>& after_;
  int next_ = 0;
};

Relay::Relay(long type, std::size_t most, const char* what)
    : type_(type), what_(what), sending_(kSending), receiving_(kReceiving) {
  constexpr std::size_t kLine = 64;
  const std::size_t piece = (sizeof(Head) + std::max(most, wire::kRelayPiece) + kLine - 1) / kLine * kLine;
  memory_ = messages::PrivateMemory(piece * (kSending + kReceiving));
  std::span<std::byte> rest = memory_.bytes();
  for (auto* buffers : {&sending_, &receiving_})
    for (Buffer& buffer : *buffers) buffer.bytes = rest.first(piece), rest = rest.subspan(piece);
}

void Relay::exchange(const Collectors& collectors, Relayed& relayed) {
  const Ring ring(collectors, heads_after_);
  const bool receives = ring.is_head() && expect_parts(ring, relayed);
  if (receives)
    for (std::size_t i = 0; i < kAwaiting; ++i) post(receiving_[(next_received_ + i) % kReceiving]);
  send_part(ring, relayed);
  while (parts_left_ > 0) receive_piece(ring, relayed);
  if (ring.is_head())
    collectors.for_others_here([this](int node) { csend(type_, nullptr, 0, node, 0); });
  else if (collectors.contributes(collectors.self()))
    crecv(type_, nullptr, 0);
  finish(receives);
}

// Whether there are any of others.
bool Relay::expect_parts(const Ring& ring, const Relayed& relayed) {
  const Collectors& nodes = ring.nodes();
  is_whole_.assign(static_cast<std::size_t>(nodes.last() - nodes.first()), 1);
  parts_left_ = 0;
  for (int node = nodes.first(); node < nodes.last(); ++node) {
    if (node == nodes.self() || !relayed.has_part(node)) continue;
    is_whole_[nodes.index(node)] = 0;
    ++parts_left_;
  }
  return parts_left_ > 0;
}

// Between its own pieces a head passes on what has come, so that none wait there for long.
void Relay::send_part(const Ring& ring, Relayed& relayed) {
  const Collectors& nodes = ring.nodes();
  const int self = nodes.self(), head = nodes.head_of(self);
  if (!relayed.has_part(self)) return;
  if (head != self && nodes.collects(head)) csend(type_, nullptr, 0, head, 0);
  if (ring.entry() == kNone) return;
  bool is_last = false;
  while (!is_last) {
    is_last = send_piece(ring.entry(), relayed);
    while (parts_left_ > 0 && has_come()) receive_piece(ring, relayed);
  }
}

bool Relay::send_piece(int to, Relayed& relayed) {
  Buffer& buffer = sending_[next_sent_++ % kSending];
  wait(buffer);
  const std::size_t bytes = relayed.is_left() ? relayed.fill(buffer.bytes.subspan(sizeof(Head))) : 0;
  const Head head{static_cast<std::int32_t>(mynode()), relayed.is_left() ? 0u : 1u};
  std::memcpy(buffer.bytes.data(), &head, sizeof head);
  buffer.message = isend(type_, buffer.bytes.data(), static_cast<long>(sizeof head + bytes), to, 0);
  return head.last == 1;
}

bool Relay::has_come() {
  Buffer& buffer = receiving_[next_received_ % kReceiving];
  if (msgdone(buffer.message) == 0) return false;
  buffer.message = kNone;
  return true;
}

// The piece goes on before it is used here. Its buffer is posted again when it has gone.
void Relay::receive_piece(const Ring& ring, Relayed& relayed) {
  Buffer& buffer = receiving_[next_received_ % kReceiving];
  wait(buffer);
  const auto bytes = static_cast<std::size_t>(infocount());
  const auto from = static_cast<int>(infonode());
  post(receiving_[(next_received_++ + kAwaiting) % kReceiving]);
  if (bytes == 0) return note_whole(ring, from);
  Head head{};
  wire::require_sense(bytes >= sizeof head, from, what_);
  std::memcpy(&head, buffer.bytes.data(), sizeof head);
  wire::require_sense(ring.nodes().has(head.owner) && !ring.nodes().share_a_machine(head.owner, ring.nodes().self()),
                      from, what_);
  if (ring.passes_on(head.owner))
    buffer.message = isend(type_, buffer.bytes.data(), static_cast<long>(bytes), ring.next(), 0);
  relayed.take(head.owner, buffer.bytes.subspan(sizeof head, bytes - sizeof head));
  if (head.last == 1) note_whole(ring, head.owner);
}

void Relay::note_whole(const Ring& ring, int owner) {
  wire::require_sense(ring.nodes().has(owner), owner, what_);
  const std::uint8_t was_whole = std::exchange(is_whole_[ring.nodes().index(owner)], std::uint8_t{1});
  wire::require_sense(was_whole == 0, owner, what_);
  --parts_left_;
}

void Relay::post(Buffer& buffer) {
  wait(buffer);
  buffer.message = irecv(type_, buffer.bytes.data(), static_cast<long>(buffer.bytes.size()));
}

void Relay::wait(Buffer& buffer) {
  if (const long message = std::exchange(buffer.message, kNone); message != kNone) msgwait(message);
}

// Nothing comes any more to the receives that were posted last.
void Relay::finish(bool has_received) {
  for (std::size_t i = 0; has_received && i < kAwaiting; ++i) {
    Buffer& buffer = receiving_[next_received_++ % kReceiving];
    msgcancel(std::exchange(buffer.message, kNone));
  }
  for (auto* buffers : {&sending_, &receiving_})
    for (Buffer& buffer : *buffers) wait(buffer);
  messages::discard(memory_.bytes());
}

}  // namespace mars::group
