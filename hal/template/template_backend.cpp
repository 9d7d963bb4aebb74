#include "hal/template/template_backend.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "hal/failure/failure.h"
#include "hal/messages/memory_file.h"
#include "hal/messages/pages.h"

namespace mars::transport_template {
// With many ranks: hand the bytes to the transport, or copy them and hand over the copy when it can take them.
// Must return though the receiver does nothing, or two nodes that send first would wait for each other for
// ever.
void TemplateBackend::send(int to, int type, const void* data, std::size_t length) {
  check(to == rank(), "a world of one node has no other");
  arrived_.push(pool_.copy({rank(), type, length}, data));
}

// With many ranks: where the transport takes bytes from where they lie, begin that, and remember under the
// ticket how its end shows. Copying is always allowed.
messages::Ticket TemplateBackend::start_send(int to, int type, const void* data, std::size_t length) {
  send(to, type, data, length);
  return 0;
}

// With many ranks: move the transport on a little, for nothing else may; true once, then the ticket is free.
bool TemplateBackend::sent(messages::Ticket) { return true; }

// With many ranks: take what the transport has brought, from each sender in the order sent, and return the
// first. The same until it is taken.
std::optional<messages::Envelope> TemplateBackend::peek() {
  if (arrived_.empty()) return std::nullopt;
  return arrived_.front()->envelope;
}

// With many ranks: here a long message may be fetched from its sender, straight to where it is wanted.
void TemplateBackend::take(void* buffer) {
  messages::Message* message = arrived_.pop();
  if (message->envelope.length > 0) std::memcpy(buffer, message->bytes(), message->envelope.length);
  pool_.release(message);
}

// With many ranks: wait for the transport's own sign of news (a descriptor, a condition, a futex) if it has
// one. The first turns must be short, or every answer is late; later ones long, or waiting costs a core.
void TemplateBackend::idle(int turn, std::chrono::microseconds longest) {
  std::this_thread::sleep_for(std::min(std::chrono::microseconds(20 << std::min(turn, 10)), longest));
}

// With many ranks: which nodes are on one machine. Its own answer for each node is allowed: nothing is shared
// then.
messages::Neighbourhood TemplateBackend::neighbourhood() { return {rank(), 0, 1, rank(), false}; }

// With many nodes a machine: memory that they all see, made by all of them together; where one cannot have it, none
// has.
std::shared_ptr<std::byte> TemplateBackend::share(std::size_t bytes) {
  std::shared_ptr<std::byte> block = messages::map_pages(bytes);
  if (block == nullptr) throw messages::too_much_to_share(bytes, "");
  return block;
}

// With many ranks: between processes of one machine this does. Else an empty offer: everything then goes by messages.
messages::Offer TemplateBackend::offer(std::size_t bytes) {
  std::string refusal;
  return messages::offer_file(rank(), bytes, refusal);
}

// With many ranks: nullptr for those of other machines.
std::shared_ptr<std::byte> TemplateBackend::attach(int rank, const messages::MemoryName& name, std::size_t bytes) {
  std::string refusal;
  return messages::attach_file(rank, name, bytes, refusal);
}

// With many ranks: inform all that this one has come to its end and how many messages it sent to each; true
// when all have come, and as many messages have arrived here as were sent to this rank.
bool TemplateBackend::finish() { return arrived_.empty(); }

// With many ranks: make every other end too, at once and without waiting: the transport's own abort, a
// signal, a connection that breaks.
void TemplateBackend::abort(const std::string& reason) {
  std::fprintf(stderr, "%s\n", reason.c_str());
  std::_Exit(1);
}

}  // namespace mars::transport_template
