#include "node/group/team_bands.h"

#include <cstring>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/wire/commands.h"
#include "node/wire/protocol.h"

namespace mars::group {
namespace {

constexpr const char* kWhat = "bands of an inbetween";

void wait(long& id) {
  if (id >= 0) msgwait(id);
  id = -1;
}

}  // namespace

TeamBands::TeamBands(const collectives::Group& group) : group_(group), came_(static_cast<std::size_t>(group.count)) {}

void TeamBands::send(std::uint32_t frame, std::span<const std::byte> bands, int writer) {
  Sent& sent = sent_[next_ = (next_ + 1) % sent_.size()];
  wait(sent.id);
  const wire::InbetweenBands head{frame};
  sent.message.resize(sizeof head + bands.size());
  std::memcpy(sent.message.data(), &head, sizeof head);
  if (!bands.empty()) std::memcpy(sent.message.data() + sizeof head, bands.data(), bands.size());
  sent.id = isend(wire::kBands, sent.message.data(), static_cast<long>(sent.message.size()), writer, 0);
}

std::optional<std::span<const std::byte>> TeamBands::receive(std::uint32_t frame, int from, Outbox& outbox) {
  std::deque<Message>& came = came_from(from);
  while (came.empty()) {
    cprobe(wire::any_of(wire::kBands, wire::kStop, wire::kLoad));
    if (infotype() != wire::kBands) {
      outbox.look_for_stop();
      return std::nullopt;
    }
    receive_probed();
  }
  if (came.front().empty()) return std::nullopt;
  taken_ = std::move(came.front());
  came.pop_front();
  wire::InbetweenBands head;
  wire::require_sense(taken_.size() >= sizeof head, from, kWhat);
  std::memcpy(&head, taken_.data(), sizeof head);
  wire::require_sense(head.frame == frame, from, kWhat);
  return std::span(std::as_const(taken_)).subspan(sizeof head);
}

void TeamBands::receive_probed() {
  const auto from = static_cast<int>(infonode());
  wire::require_sense(from >= team_.first && from < team_.first + team_.count, from, kWhat);
  Message& message = came_from(from).emplace_back(static_cast<std::size_t>(infocount()));
  crecv(wire::kBands, message.data(), static_cast<long>(message.size()));
}

// An empty message of each other node is its last.
void TeamBands::finish() {
  const auto self = static_cast<int>(mynode());
  for (int node = team_.first; node < team_.first + team_.count; ++node) {
    if (node == self) continue;
    csend(wire::kBands, nullptr, 0, node, 0);
    std::deque<Message>& came = came_from(node);
    while (came.empty() || !came.back().empty()) {
      came.clear();
      cprobe(wire::kBands);
      receive_probed();
    }
  }
  for (Sent& sent : sent_) wait(sent.id);
  for (std::deque<Message>& came : came_) came.clear();
  team_ = {0, 0};
}

}  // namespace mars::group
