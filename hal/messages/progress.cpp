#include "hal/messages/progress.h"

#include <chrono>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "hal/messages/call_failure.h"

namespace mars::messages {
namespace {

// At most: a message ends it.
constexpr std::chrono::microseconds kSleep{10000};

// Within a message whose bytes come: only a look finds the next of them.
constexpr std::chrono::microseconds kBlindSleep{1000};

// From one call of what is called while waiting to the next: the longest pauses add up to a sixth of a second.
constexpr unsigned kPausesACall = 16;

void describe(const Envelope& envelope, long* info) {
  if (info == nullptr) return;
  const long numbers[8] = {envelope.type, static_cast<long>(envelope.length), envelope.from};
  std::memcpy(info, numbers, sizeof numbers);
}

}  // namespace

Progress::Progress(Backend& backend)
    : Caller(backend),
      acknowledgement_(kFirstInternalType + backend.nodes()),
      own_pool_(backend.pool() == nullptr ? std::make_unique<MessagePool>() : nullptr),
      pool_(own_pool_ ? *own_pool_ : *backend.pool()),
      ledger_(backend.host()) {}

Request& Progress::checked(const char* call, Request* request) const {
  if (request == nullptr) {
    fail(call, kNoFreeId, "all " + std::to_string(kMessageIds) + " message ids are in use",
         "free them by msgwait, or msgdone until it is 1");
  }
  return *request;
}

void Progress::receive_now(const char* call, const Selection& selection, const ReceiveBuffer& into, long* info) {
  attend();
  if (receive_soon(selection, into, info)) return;
  Request& request = checked(call, requests_.acquire(call));
  request.info = info;
  start_receive(selection, into, request);
  wait_or_cancel(request);
}

// The quick way, where it does not show that other messages are overtaken.
bool Progress::receive_soon(const Selection& selection, const ReceiveBuffer& into, long* info) {
  if (selection.typesel < 0 || type_class(selection.typesel) == TypeClass::force) return false;
  if (!matching_.none_posted() || matching_.find(selection) != nullptr) return false;
  if (selection.from != -1 && type_class(selection.typesel) == TypeClass::ordinary) return false;
  if (ledger_.recorder() != nullptr || rendezvous_.strict()) return false;
  if (!backend_.receive_soon(selection.typesel, into.data, into.capacity, info_)) return false;
  overtaken_ = true;
  ledger_.taken(info_);
  describe(info_, info);
  quiet_turns_ = 0;
  return true;
}

// Force messages that others sent before, and that were overtaken, are discarded.
void Progress::settle_overtaken() {
  while (overtaken_) {
    const std::optional<Envelope> next = backend_.peek();
    overtaken_ = next && next->from != backend_.rank();
    if (overtaken_) settle(*next);
  }
}

// Done at once if its message is here already.
void Progress::start_receive(const Selection& selection, const ReceiveBuffer& into, Request& request) {
  if (selection.typesel >= 0 && type_class(selection.typesel) == TypeClass::force) settle_overtaken();
  request.selection = selection;
  request.buffer = into.data;
  request.capacity = into.capacity;
  request.state = Request::State::receiving;
  Message* message = matching_.find(selection);
  if (message == nullptr) return matching_.post(request);
  if (message->envelope.length > into.capacity) return mark_too_long(request, message->envelope);
  matching_.remove(message);
  deliver(message, request);
}

// The message stays where it is, or goes on to another receive.
void Progress::mark_too_long(Request& request, const Envelope& envelope) {
  request.envelope = envelope;
  request.state = Request::State::too_long;
}

void Progress::fail_too_long(const Request& request) const {
  fail(request.call, kMessageTooLong,
       "a message of " + bytes_text(request.envelope.length) + ", type " + std::to_string(request.envelope.type) +
           ", from " + rank_name(request.envelope.from, backend_.host()) + " does not fit a receive of " +
           bytes_text(request.capacity),
       "receive into a longer buffer, or cprobe first and ask infocount");
}

bool Progress::done(Request& head) {
  for (Request* each = &head; each != nullptr; each = each->also) {
    if (!done_alone(*each)) return false;
  }
  return true;
}

bool Progress::done_alone(Request& request) {
  if (request.state == Request::State::coming) return has_come(request);
  if (request.state == Request::State::sending && backend_.sent(request.ticket)) {
    request.state = Request::State::unreceived;
  }
  if (request.state == Request::State::unreceived && request.unreceived == 0) {
    request.state = Request::State::sent;
  }
  return request.state == Request::State::received || request.state == Request::State::sent ||
         request.state == Request::State::too_long;
}

void Progress::wait(Request& head) try {
  const double begin = ledger_.begin();
  rendezvous_.end_silence();
  bool idle = false;
  for (int turn = 0; !done(head);) {
    if (pass_for(head, turn)) continue;
    idle = true;
    if (rendezvous_.strict()) rendezvous_.report_silence(*this, head);
  }
  if (idle) {
    ledger_.waited(head.state == Request::State::received ? head.envelope : Envelope{-1, -1, 0}, begin);
  }
  conclude(head);
} catch (const CallFailure&) {
  throw;
} catch (...) {
  // A backend that ends a job at a standstill does not know which rank waits for which.
  if (rendezvous_.strict() && head.state != Request::State::free) rendezvous_.report_wait(*this, head);
  throw;
}

// For requests that only the waiting call knows: a handler that fails ends it.
void Progress::wait_or_cancel(Request& request) try { wait(request); } catch (...) {
  if (request.state != Request::State::free) cancel(request);
  throw;
}

// One turn of a wait; false when there was nothing to do but to let time pass.
bool Progress::pass(int& turn) {
  bool moved = arrive();
  if (handlers_.any() && call_handlers()) moved = true;
  if (moved)
    turn = 0;
  else
    let_pass(turn++, kSleep);
  return moved;
}

// While its bytes come nothing else is taken: what others send may have a receive soon, and needs no copy then.
bool Progress::pass_for(const Request& head, int& turn) {
  if (head.state != Request::State::coming) return pass(turn);
  let_pass(turn++, kBlindSleep);
  return false;
}

void Progress::while_waiting(std::function<void()> call) {
  if (!backend_.has_machine_clock()) return;
  while_waiting_ = std::move(call);
  backend_.while_waiting(while_waiting_ ? [this] { call_while_waiting(); } : std::function<void()>());
}

void Progress::let_pass(int turn, std::chrono::microseconds longest) {
  backend_.idle(turn, longest);
  if (while_waiting_) call_while_waiting();
}

void Progress::call_while_waiting() {
  if (is_calling_ || pauses_to_call_-- > 0) return;
  pauses_to_call_ = kPausesACall - 1;
  const Envelope before = info_;
  is_calling_ = true;
  try {
    while_waiting_();
  } catch (...) {
    is_calling_ = false;
    throw;
  }
  is_calling_ = false;
  info_ = before;
}

// Ends a done request and those merged with it. Its info is that of its first receive.
void Progress::conclude(Request& head) {
  const Request* failed = nullptr;
  bool any_received = false;
  for (const Request* each = &head; each != nullptr; each = each->also) {
    if (each->state == Request::State::too_long) failed = each;
    if (each->state != Request::State::received) continue;
    if (!any_received) info_ = each->envelope;
    any_received = true;
    describe(each->envelope, each->info);
  }
  if (failed == nullptr) return release(head);
  const Request copy = *failed;
  release(head);
  fail_too_long(copy);
}

void Progress::release(Request& head) {
  for (Request* each = &head; each != nullptr;) {
    Request* next = each->also;
    requests_.release(*each);
    each = next;
  }
}

// A message that was received already is there to be received again; one that goes out has gone on return.
void Progress::cancel(Request& head) {
  for (Request* each = &head; each != nullptr; each = each->also) {
    rendezvous_.forget(*each);
    each->unreceived = 0;
    if (each->state == Request::State::receiving) matching_.unpost(*each);
    await_rest(*each);
    if (each->state == Request::State::received) give_back(*each);
    for (int turn = 0; each->state == Request::State::sending && !done_alone(*each);) pass(turn);
  }
  release(head);
}

void Progress::give_back(const Request& request) {
  Message* message = pool_.copy(request.envelope, request.buffer);
  message->number = request.number;
  message->arrival = request.arrival;
  if (Request* other = claim(message->envelope)) {
    deliver(message, *other);
  } else if (type_class(message->envelope.type) == TypeClass::force) {
    pool_.release(message);
  } else {
    matching_.queue(message);
  }
}

void Progress::leave_to(const Handler& handler, Request& request) {
  request.handler = handler;
  await_rest(request);
  handlers_.add(request);
  attend();
}

void Progress::attend() {
  if (!handlers_.any()) return;
  call_handlers();
  while (arrive()) call_handlers();
}

bool Progress::call_handlers() {
  bool called = false;
  for (;;) {
    handlers_.sort_out([this](Request& request) { return done(request); });
    Request* due = handlers_.next();
    if (due == nullptr) return called;
    call_handler(*due);
    called = true;
  }
}

// The handler's info is that of its message; the call in which it runs does not see it.
void Progress::call_handler(Request& head) {
  const Handler handler = head.handler;
  const Envelope envelope = head.envelope;
  if (!handler) return release(head);
  const Envelope before = info_;
  conclude(head);
  const HandlerQueue::Running running(handlers_);
  handler(envelope);
  info_ = before;
}

void Progress::probe(const char* call, const Selection& selection, long* info) {
  if (selection.typesel >= 0 && type_class(selection.typesel) == TypeClass::force) {
    fail(call, kBadType, "no force message ever waits to be found", "post a receive for it");
  }
  Request waiting;
  waiting.call = call;
  waiting.state = Request::State::receiving;
  waiting.selection = selection;
  attend();
  const double begin = ledger_.begin();
  rendezvous_.end_silence();
  int turn = 0;
  while (!look(selection)) {
    if (handlers_.any() && call_handlers()) continue;
    let_pass(turn++, kSleep);
    if (rendezvous_.strict()) rendezvous_.report_silence(*this, waiting);
  }
  if (turn > 0) ledger_.waited(info_, begin);
  describe(info_, info);
}

bool Progress::probe_once(const Selection& selection, long* info) {
  attend();
  if (!look(selection)) return false;
  describe(info_, info);
  return true;
}

bool Progress::found(const Message* message) {
  if (message != nullptr) info_ = message->envelope;
  return message != nullptr;
}

// Leaves a message that it finds in the backend, so that the receive after a probe takes it from there.
bool Progress::look(const Selection& selection) {
  if (found(matching_.find(selection))) return true;
  // One look a turn: what arrived between two would be stored, and then be received before what was found.
  bool settled = false;
  while (const std::optional<Envelope> next = backend_.peek()) {
    if (selection.selects(*next) && type_class(next->type) == TypeClass::ordinary &&
        matching_.posted_for(*next) == nullptr) {
      info_ = *next;
      quiet_turns_ = 0;
      return true;
    }
    settle(*next);
    settled = true;
  }
  return settled && found(matching_.find(selection));
}

// Takes the next arrived message to where it belongs; false if there is none.
bool Progress::arrive() {
  const std::optional<Envelope> next = backend_.peek();
  if (next) settle(*next);
  return next.has_value();
}

void Progress::settle(const Envelope& next) {
  quiet_turns_ = 0;
  rendezvous_.end_silence();
  if (next.type == acknowledgement_) {
    std::uint32_t number = 0;
    take(next, &number);
    rendezvous_.received(next.from, number);
  } else if (Request* request = claim(next)) {
    receive_into(*request, next);
  } else if (type_class(next.type) == TypeClass::force) {
    discard(next);
  } else {
    store(next);
  }
}

// The posted receive that gets such a message, or nullptr. Those before it that are too short have failed.
Request* Progress::claim(const Envelope& envelope) {
  for (;;) {
    Request* request = matching_.posted_for(envelope);
    if (request == nullptr) return nullptr;
    matching_.unpost(*request);
    if (envelope.length <= request->capacity) return request;
    mark_too_long(*request, envelope);
  }
}

// Handlers run in the order in which their messages began to arrive: they wait for the whole.
void Progress::receive_into(Request& request, const Envelope& envelope) {
  request.ticket = start_take(envelope, request.buffer, request.number);
  request.arrival = matching_.next_arrival();
  request.envelope = envelope;
  request.state = Request::State::coming;
  if (request.ticket == kNoTicket) has_come(request);
  if (request.handler) await_rest(request);
}

// From the queue of those that wait.
void Progress::deliver(Message* message, Request& request) {
  request.envelope = message->envelope;
  request.number = message->number;
  request.arrival = message->arrival;
  request.queued = message;
  request.state = Request::State::coming;
  has_come(request);
}

// Of a request whose message is coming: whether all of it is here, which ends that.
bool Progress::has_come(Request& request) {
  if (request.queued != nullptr) {
    if (!is_here(*request.queued)) return false;
    Message* message = std::exchange(request.queued, nullptr);
    if (request.envelope.length > 0) std::memcpy(request.buffer, message->bytes(), request.envelope.length);
    pool_.release(message);
  } else if (request.ticket != kNoTicket) {
    if (!backend_.sent(request.ticket)) return false;
    ledger_.record_taken(request.envelope, ledger_.begin(), request.number);
  }
  request.state = Request::State::received;
  acknowledge(request.envelope, request.number);
  return true;
}

bool Progress::is_here(Message& message) {
  if (message.ticket == kNoTicket) return true;
  if (!backend_.sent(message.ticket)) return false;
  message.ticket = kNoTicket;
  ledger_.record_taken(message.envelope, ledger_.begin(), message.number);
  return true;
}

void Progress::await_rest(Request& request) {
  for (int turn = 0; request.state == Request::State::coming && !has_come(request);) pass_for(request, turn);
}

// Nobody wants it, and it is no longer among those that wait.
void Progress::drop(Message* message) {
  for (int turn = 0; !is_here(*message);) let_pass(turn++, kBlindSleep);
  pool_.release(message);
}

void Progress::store(const Envelope& envelope) {
  Message* message = pool_.acquire(envelope);
  message->ticket = start_take(envelope, message->bytes(), message->number);
  message->arrival = matching_.next_arrival();
  matching_.queue(message);
}

void Progress::discard(const Envelope& envelope) {
  Message* message = pool_.acquire(envelope);
  take(envelope, message->bytes());
  pool_.release(message);
}

std::uint32_t Progress::take(const Envelope& envelope, void* buffer) {
  const double begin = ledger_.begin();
  backend_.take(buffer);
  const std::uint32_t number = ledger_.taken(envelope);
  ledger_.record_taken(envelope, begin, number);
  return number;
}

// The ticket of bytes that are still to come, or kNoTicket.
Ticket Progress::start_take(const Envelope& envelope, void* buffer, std::uint32_t& number) {
  const double begin = ledger_.begin();
  const Ticket ticket = backend_.start_take(buffer).value_or(kNoTicket);
  number = ledger_.taken(envelope);
  if (ticket == kNoTicket) ledger_.record_taken(envelope, begin, number);
  return ticket;
}

}  // namespace mars::messages
