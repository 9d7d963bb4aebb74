// How messages leave.
#include <cstdint>
#include <optional>

#include "hal/messages/progress.h"

namespace mars::messages {

void Progress::send_now(const char* call, const Outgoing& message) {
  if (!rendezvous_.concerns(message.type, message.length)) return send_copies(message, nullptr);
  Request& request = checked(call, requests_.acquire(call));
  request.envelope = message.envelope();
  request.state = Request::State::unreceived;
  send_copies(message, &request);
  wait_or_cancel(request);
}

// Where there is a strict request, it is done once all have received.
void Progress::send_copies(const Outgoing& message, Request* strict) {
  for (int to = message.receivers.first; to < message.receivers.last; ++to) {
    if (message.receivers.several && to == backend_.rank()) continue;
    const double begin = ledger_.begin();
    const std::optional<Ticket> ticket = backend_.send_or_start(to, message.type, message.data, message.length);
    const std::uint32_t number = ledger_.sent({to, message.type, message.length}, begin);
    if (strict != nullptr) rendezvous_.expect(to, number, *strict);
    if (ticket) wait_sent(*ticket);
  }
}

void Progress::wait_sent(Ticket ticket) {
  for (int turn = 0; !backend_.sent(ticket);) pass(turn);
}

void Progress::start_send(const Outgoing& message, Request& request) try {
  request.envelope = message.envelope();
  Request* strict = rendezvous_.concerns(message.type, message.length) ? &request : nullptr;
  if (message.receivers.several) {
    send_copies(message, strict);
    request.state = Request::State::unreceived;
    return;
  }
  const double begin = ledger_.begin();
  request.ticket = backend_.start_send(message.receivers.first, message.type, message.data, message.length);
  const std::uint32_t number = ledger_.sent(request.envelope, begin);
  if (strict != nullptr) rendezvous_.expect(message.receivers.first, number, request);
  request.state = Request::State::sending;
} catch (...) {
  requests_.release(request);
  throw;
}

// Informs a strict sender that its message has been received.
void Progress::acknowledge(const Envelope& envelope, std::uint32_t number) {
  if (!rendezvous_.concerns(envelope.type, envelope.length)) return;
  const double begin = ledger_.begin();
  backend_.send(envelope.from, acknowledgement_, &number, sizeof number);
  ledger_.sent({envelope.from, acknowledgement_, sizeof number}, begin);
}

}  // namespace mars::messages
