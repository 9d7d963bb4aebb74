#include "hal/process.h"

#include <cstring>
#include <utility>

#include "hal/call_failure.h"
#include "hal/message_types.h"
#include "hal/nx/nx_messages.h"

namespace mars::hal {
namespace {

// At a time: for a message, which wakes; and for what else there may be to look at.
constexpr std::chrono::microseconds kSleep{10000};
constexpr std::chrono::microseconds kFlick{1000};

thread_local Process* bound_process = nullptr;
FindProcess find_process = nullptr;

std::string bytes_text(std::size_t bytes) {
  return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes");
}

}  // namespace

std::string rank_name(int rank, int host) {
  return rank == host ? "the host" : "node " + std::to_string(rank);
}

void find_process_by(FindProcess find) { find_process = find; }

Process& process() {
  if (bound_process == nullptr && find_process != nullptr) return find_process();
  if (bound_process == nullptr) {
    throw Failure("a message call on a thread that is neither a node nor the host", "",
                  "make NX calls only on the thread that runs a node's or the host's body");
  }
  return *bound_process;
}

const Traffic& traffic() { return process().traffic(); }

Process::Process(Backend& backend)
    : backend_(backend), numbers_(static_cast<std::size_t>(backend.nodes()) + 1) {
  check(bound_process == nullptr, "a thread is at most one process");
  check(backend.nodes() <= kInternalTypes, "every node has an internal type");
  bound_process = this;
}

Process::~Process() { bound_process = nullptr; }

void Process::fail(const char* call, int code, const std::string& what, const std::string& remedy) const {
  throw CallFailure(code, what, rank_name(backend_.rank(), backend_.host()) + ", " + call, remedy);
}

std::size_t Process::check_buffer(const char* call, const void* buffer, long length) const {
  if (length < 0) {
    fail(call, EQLEN, "length " + std::to_string(length) + " is negative", "give a length in bytes");
  }
  if (buffer == nullptr && length > 0) {
    fail(call, EQPBUF, "the buffer of " + bytes_text(static_cast<std::size_t>(length)) + " is a null pointer",
         "give a buffer, or length 0");
  }
  return static_cast<std::size_t>(length);
}

Process::Receivers Process::check_send(const char* call, long type, const void* buffer, long length, long node,
                                       long pid) const {
  if (type_class(type) == TypeClass::reserved) {
    fail(call, EQTYPE, "message type " + std::to_string(type) + " is reserved",
         "use 0 to 999999999, or 1073741824 to 1999999999 for force messages");
  }
  check_buffer(call, buffer, length);
  if (pid != 0 && pid != -1) {
    fail(call, EQPID, "there is no pid " + std::to_string(pid), "every node runs one process, pid 0");
  }
  if (node == -1) return {0, backend_.nodes(), true};
  if (node < 0 || node > backend_.host()) {
    fail(call, EQNODE, "there is no node " + std::to_string(node),
         "nodes are 0 to " + std::to_string(backend_.nodes() - 1) +
             ", the host is myhost(), -1 is all others");
  }
  return {static_cast<int>(node), static_cast<int>(node) + 1, false};
}

std::int32_t Process::check_typesel(const char* call, long typesel) const {
  const std::int32_t narrow = narrow_typesel(typesel);
  if (narrow >= 0 && type_class(narrow) == TypeClass::reserved) {
    fail(call, EQTYPE, "typesel " + std::to_string(narrow) + " is a reserved type",
         "use 0 to 999999999, -1 for any, or 1073741824 to 1999999999 for force messages");
  }
  return narrow;
}

void Process::check_fits(const Request& request, const Envelope& envelope) const {
  if (envelope.length <= request.capacity) return;
  fail(request.call, EQMSGLONG,
       "a message of " + bytes_text(envelope.length) + ", type " + std::to_string(envelope.type) + ", from " +
           rank_name(envelope.from, backend_.host()) + " does not fit a receive of " +
           bytes_text(request.capacity),
       "receive into a longer buffer, or cprobe first and ask infocount");
}

double Process::recorded_time() const { return recorder_ == nullptr ? 0 : dclock(); }

void Process::note_sent(int to, int type, std::size_t length, double begin) {
  Traffic::Count& sent = to == backend_.host() ? traffic_.to_host : traffic_.to_nodes;
  ++sent.messages;
  sent.bytes += length;
  const std::uint32_t number = numbers_[static_cast<std::size_t>(to)].sent++;
  if (recorder_ != nullptr) recorder_->message(Event::Kind::sent, begin, {to, type, length}, number);
}

void Process::send(const Receivers& receivers, int type, const void* data, std::size_t length) {
  for (int to = receivers.first; to < receivers.last; ++to) {
    if (receivers.several && to == backend_.rank()) continue;
    const double begin = recorded_time();
    backend_.send(to, type, data, length);
    note_sent(to, type, length, begin);
  }
}

void Process::csend(long type, const void* buffer, long length, long node, long pid) {
  const Receivers receivers = check_send("csend", type, buffer, length, node, pid);
  send(receivers, static_cast<int>(type), buffer, static_cast<std::size_t>(length));
}

long Process::isend(long type, const void* buffer, long length, long node, long pid) {
  const Receivers receivers = check_send("isend", type, buffer, length, node, pid);
  const auto bytes = static_cast<std::size_t>(length);
  Request& request = new_request("isend");
  if (receivers.several) {
    send(receivers, static_cast<int>(type), buffer, bytes);
    request.state = Request::State::sent;
  } else {
    const double begin = recorded_time();
    request.ticket = backend_.start_send(receivers.first, static_cast<int>(type), buffer, bytes);
    note_sent(receivers.first, static_cast<int>(type), bytes, begin);
    request.state = Request::State::sending;
  }
  return request.mid();
}

void Process::crecv(long typesel, void* buffer, long length) {
  const std::int32_t narrow = check_typesel("crecv", typesel);
  wait(receive("crecv", narrow, buffer, check_buffer("crecv", buffer, length)));
}

long Process::irecv(long typesel, void* buffer, long length) {
  const std::int32_t narrow = check_typesel("irecv", typesel);
  return receive("irecv", narrow, buffer, check_buffer("irecv", buffer, length)).mid();
}

Request& Process::new_request(const char* call) {
  Request* request = requests_.acquire(call);
  if (request == nullptr)
    fail(call, EQNOMID, "all message ids are in use", "free them by msgwait, or msgdone until it is 1");
  return *request;
}

Request& Process::known_request(const char* call, long mid) {
  Request* request = requests_.find(mid);
  if (request == nullptr) {
    fail(call, EQMID, "there is no message id " + std::to_string(mid),
         "an id is free after its msgwait, or its msgdone that was 1");
  }
  return *request;
}

// Starts a receive: done at once if its message is here already.
Request& Process::receive(const char* call, std::int32_t typesel, void* buffer, std::size_t length) {
  Request& request = new_request(call);
  request.state = Request::State::receiving;
  request.typesel = typesel;
  request.buffer = buffer;
  request.capacity = length;
  Message* message = unexpected_.find([typesel](int type) { return selects(typesel, type); });
  if (message == nullptr) {
    requests_.post(request);
    return request;
  }
  if (message->envelope.length > length) requests_.release(request);
  check_fits(request, message->envelope);
  unexpected_.remove(message);
  if (message->envelope.length > 0) std::memcpy(buffer, message->bytes(), message->envelope.length);
  request.envelope = message->envelope;
  request.state = Request::State::received;
  pool_.release(message);
  return request;
}

bool Process::done(Request& request) {
  if (request.state == Request::State::sending && backend_.sent(request.ticket)) {
    request.state = Request::State::sent;
  }
  return request.state == Request::State::sent || request.state == Request::State::received;
}

void Process::conclude(Request& request) {
  if (request.state == Request::State::received) info_ = request.envelope;
  requests_.release(request);
}

void Process::wait(Request& request) {
  const double begin = recorded_time();
  bool idle = false;
  for (int turn = 0; !done(request);) {
    if (arrive()) {
      turn = 0;
    } else {
      idle = true;
      backend_.idle(turn++, kSleep);
    }
  }
  if (idle) note_wait(request.state == Request::State::received ? request.envelope : Envelope{-1, -1, 0}, begin);
  conclude(request);
}

void Process::note_wait(const Envelope& came, double begin) {
  if (recorder_ != nullptr) recorder_->message(Event::Kind::waited, begin, came, 0);
}

void Process::msgwait(long mid) { wait(known_request("msgwait", mid)); }

bool Process::msgdone(long mid) {
  Request& request = known_request("msgdone", mid);
  while (!done(request) && arrive()) {
  }
  if (!done(request)) return false;
  conclude(request);
  return true;
}

void Process::cprobe(long typesel) {
  const std::int32_t narrow = check_typesel("cprobe", typesel);
  const double begin = recorded_time();
  int turn = 0;
  for (; !look(narrow); ++turn) backend_.idle(turn, kSleep);
  if (turn > 0) note_wait(info_, begin);
}

bool Process::iprobe(long typesel) { return look(check_typesel("iprobe", typesel)); }

// Leaves a message that it finds in the backend, so that the receive after a probe takes it from there.
bool Process::look(std::int32_t typesel) {
  if (const Message* message = unexpected_.find([typesel](int type) { return selects(typesel, type); })) {
    info_ = message->envelope;
    return true;
  }
  // One look a turn: what arrived between two would be kept, and then be received before what was told of.
  while (const std::optional<Envelope> next = backend_.peek()) {
    if (selects(typesel, next->type) && requests_.posted_for(next->type) == nullptr) {
      info_ = *next;
      quiet_turns_ = 0;
      return true;
    }
    settle(*next);
  }
  return false;
}

// Takes the next arrived message to where it belongs; false if there is none.
bool Process::arrive() {
  const std::optional<Envelope> next = backend_.peek();
  if (next) settle(*next);
  return next.has_value();
}

void Process::settle(const Envelope& next) {
  quiet_turns_ = 0;
  if (Request* request = requests_.posted_for(next.type)) {
    receive_into(*request, next);
  } else if (type_class(next.type) == TypeClass::force) {
    discard(next);
  } else {
    keep(next);
  }
}

void Process::receive_into(Request& request, const Envelope& envelope) {
  requests_.unpost(request);
  if (envelope.length > request.capacity) requests_.release(request);
  check_fits(request, envelope);
  take(envelope, request.buffer);
  request.envelope = envelope;
  request.state = Request::State::received;
}

void Process::keep(const Envelope& envelope) {
  Message* message = pool_.acquire(envelope);
  take(envelope, message->bytes());
  unexpected_.push(message);
}

void Process::discard(const Envelope& envelope) {
  Message* message = pool_.acquire(envelope);
  take(envelope, message->bytes());
  pool_.release(message);
}

void Process::take(const Envelope& envelope, void* buffer) {
  const double begin = recorded_time();
  backend_.take(buffer);
  const std::uint32_t number = numbers_[static_cast<std::size_t>(envelope.from)].taken++;
  if (recorder_ != nullptr) recorder_->message(Event::Kind::taken, begin, envelope, number);
}

void Process::flick() { backend_.idle(quiet_turns_++, kFlick); }

void Process::send_internal(int to, const void* data, std::size_t length) {
  const int type = kFirstInternalType + backend_.rank();
  const double begin = recorded_time();
  backend_.send(to, type, data, length);
  note_sent(to, type, length, begin);
}

void Process::receive_internal(const char* call, int from, void* data, std::size_t length) {
  Request& request = receive(call, kFirstInternalType + from, data, length);
  const Envelope before = std::exchange(info_, {});
  wait(request);
  const std::size_t came = std::exchange(info_, before).length;
  if (came == length) return;
  fail(call, EQLEN,
       rank_name(from, backend_.host()) + " gave " + bytes_text(came) + " where " + bytes_text(length) +
           " belong",
       "all nodes call the same collectives in the same order with the same lengths");
}

void Process::finish() {
  for (int turn = 0; !backend_.finish();) {
    if (const std::optional<Envelope> next = backend_.peek()) {
      discard(*next);
      turn = 0;
    } else {
      backend_.idle(turn++, kFlick);
    }
  }
}

}  // namespace mars::hal
