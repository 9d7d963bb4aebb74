#include "node/tracer.h"

#include <cstddef>

#include "hal/nx/nx_messages.h"
#include "node/wire/protocol.h"

namespace mars::node {
namespace {

// Of one node: phases, and what it waits for, for some frames; and for each other node at most three events for
// its triangles and three for its CZB, each way.
std::size_t events_planned() { return 1024 + 12 * static_cast<std::size_t>(numnodes()); }

}  // namespace

Tracer::Tracer() : recorder_(events_planned(), wire::kTrace) {}

void Tracer::send() {
  if (message_ >= 0 && msgdone(message_) == 0) return;
  send_half(false);
}

void Tracer::finish() {
  if (message_ >= 0) msgwait(message_);
  send_half(true);
  msgwait(message_);
  message_ = -1;
}

void Tracer::send_half(bool last) {
  const auto events = recorder_.turn(last);
  message_ = isend(wire::kTrace, events.data(), static_cast<long>(events.size_bytes()), myhost(), 0);
}

}  // namespace mars::node
