#include "hal/messages/process.h"

#include <optional>
#include <string>

#include "hal/messages/call_failure.h"

namespace mars::messages {
namespace {

// At most: messages end it, other news do not.
constexpr std::chrono::microseconds kFlick{1000};

thread_local Process* bound_process = nullptr;
FindProcess find_process = nullptr;

}  // namespace

void find_process_by(FindProcess find) { find_process = find; }

Process& process() {
  if (bound_process == nullptr && find_process != nullptr) return find_process();
  if (bound_process == nullptr) {
    throw Failure("a message call on a thread that is neither a node nor the host", "",
                  "make NX calls only on the thread that runs a node's or the host's body");
  }
  return *bound_process;
}

double seconds() { return bound_process == nullptr ? machine_seconds() : bound_process->backend().seconds(); }

void charge(int kind, std::uint64_t units) { process().backend().charge(kind, units); }

void keep_to(int first, int count) { process().backend().keep_to(first, count); }

void keep_to_nobody() { keep_to(0, process().backend().nodes()); }

void discard(std::span<std::byte> bytes) { process().backend().discard(bytes); }

const Traffic& traffic() { return process().traffic(); }

Process::Process(Backend& backend) : Progress(backend) {
  check(bound_process == nullptr, "a thread is at most one process");
  check(backend.nodes() < kInternalTypes, "every node has an internal type, and one is left");
  bound_process = this;
}

Process::~Process() {
  while_waiting({});
  bound_process = nullptr;
}

void Process::serve_this_thread() { bound_process = this; }

Request& Process::known_request(const char* call, long mid) {
  Request* request = requests_.find(mid);
  if (request == nullptr) {
    fail(call, kNoSuchId, "there is no message id " + std::to_string(mid),
         "an id is free after its msgwait, its msgcancel, or its msgdone that was 1");
  }
  return *request;
}

void Process::csend(long type, const void* buffer, long length, long node, long pid) {
  const Outgoing message = check_send(*this, "csend", type, buffer, length, node, pid);
  attend();
  send_now("csend", message);
}

void Process::crecv(long typesel, void* buffer, long length) {
  const Selection selection = check_selection(*this, "crecv", typesel, -1, -1);
  receive_now("crecv", selection, check_receive_buffer(*this, "crecv", buffer, length), nullptr);
}

void Process::crecvx(long typesel, void* buffer, long length, long node, long pid, long* info) {
  const Selection selection = check_selection(*this, "crecvx", typesel, node, pid);
  receive_now("crecvx", selection, check_receive_buffer(*this, "crecvx", buffer, length), info);
}

long Process::csendrecv(long type, const void* out, long out_length, long node, long pid, long typesel, void* in,
                        long in_length) {
  const Outgoing message = check_send(*this, "csendrecv", type, out, out_length, node, pid);
  const Selection selection = check_selection(*this, "csendrecv", typesel, -1, -1);
  const ReceiveBuffer into = check_receive_buffer(*this, "csendrecv", in, in_length);
  attend();
  Request& answer = checked("csendrecv", requests_.acquire("csendrecv"));
  start_receive(selection, into, answer);
  try {
    send_now("csendrecv", message);
  } catch (...) {
    cancel(answer);
    throw;
  }
  wait_or_cancel(answer);
  return static_cast<long>(info_.length);
}

long Process::isend(long type, const void* buffer, long length, long node, long pid) {
  const Outgoing message = check_send(*this, "isend", type, buffer, length, node, pid);
  attend();
  Request& request = checked("isend", requests_.acquire_id("isend"));
  start_send(message, request);
  return request.mid();
}

long Process::irecv(long typesel, void* buffer, long length) {
  const Selection selection = check_selection(*this, "irecv", typesel, -1, -1);
  const ReceiveBuffer into = check_receive_buffer(*this, "irecv", buffer, length);
  attend();
  Request& request = checked("irecv", requests_.acquire_id("irecv"));
  start_receive(selection, into, request);
  return request.mid();
}

long Process::irecvx(long typesel, void* buffer, long length, long node, long pid, long* info) {
  const Selection selection = check_selection(*this, "irecvx", typesel, node, pid);
  const ReceiveBuffer into = check_receive_buffer(*this, "irecvx", buffer, length);
  attend();
  Request& request = checked("irecvx", requests_.acquire_id("irecvx"));
  request.info = info;
  start_receive(selection, into, request);
  return request.mid();
}

// One request for both, done when both are.
void Process::start_exchange(const Outgoing& message, const Selection& selection, const ReceiveBuffer& into,
                             Request& answer) {
  start_receive(selection, into, answer);
  try {
    Request& sending = checked(answer.call, requests_.acquire(answer.call));
    start_send(message, sending);
    answer.also = &sending;
  } catch (...) {
    cancel(answer);
    throw;
  }
}

long Process::isendrecv(long type, const void* out, long out_length, long node, long pid, long typesel, void* in,
                        long in_length) {
  const Outgoing message = check_send(*this, "isendrecv", type, out, out_length, node, pid);
  const Selection selection = check_selection(*this, "isendrecv", typesel, -1, -1);
  const ReceiveBuffer into = check_receive_buffer(*this, "isendrecv", in, in_length);
  attend();
  Request& answer = checked("isendrecv", requests_.acquire_id("isendrecv"));
  start_exchange(message, selection, into, answer);
  return answer.mid();
}

void Process::msgwait(long mid) {
  Request& request = known_request("msgwait", mid);
  attend();
  wait(request);
}

bool Process::msgdone(long mid) {
  Request& request = known_request("msgdone", mid);
  attend();
  while (!done(request) && request.state != Request::State::coming && arrive()) {
  }
  if (!done(request)) return false;
  conclude(request);
  return true;
}

void Process::msgcancel(long mid) {
  cancel(known_request("msgcancel", mid));
  attend();  // not before: it could receive the message into the cancelled request
}

long Process::msgmerge(long mid1, long mid2) {
  if (mid1 == -1 || mid2 == -1) return mid1 == -1 ? mid2 : mid1;
  Request* last = &known_request("msgmerge", mid1);
  Request& second = known_request("msgmerge", mid2);
  if (last == &second) fail("msgmerge", kNoSuchId, "both message ids are " + std::to_string(mid1), "give two");
  while (last->also != nullptr) last = last->also;
  last->also = &second;
  requests_.forget_id(second);
  return mid1;
}

void Process::msgignore(long mid) {
  Request& request = known_request("msgignore", mid);
  requests_.forget_id(request);
  handlers_.add(request);
  attend();
}

void Process::cprobe(long typesel) { probe("cprobe", check_selection(*this, "cprobe", typesel, -1, -1), nullptr); }

void Process::cprobex(long typesel, long node, long pid, long* info) {
  probe("cprobex", check_selection(*this, "cprobex", typesel, node, pid), info);
}

bool Process::iprobe(long typesel) { return probe_once(check_selection(*this, "iprobe", typesel, -1, -1), nullptr); }

bool Process::iprobex(long typesel, long node, long pid, long* info) {
  return probe_once(check_selection(*this, "iprobex", typesel, node, pid), info);
}

void Process::flushmsg(long typesel, long node, long pid) {
  const Selection selection = check_selection(*this, "flushmsg", typesel, node, pid);
  attend();
  while (arrive()) {
  }
  while (Message* message = matching_.find(selection)) {
    matching_.remove(message);
    acknowledge(message->envelope, message->number);
    drop(message);
  }
}

void Process::hsend(long type, const void* buffer, long length, long node, long pid, const Handler& handler) {
  const char* call = handler.extended != nullptr ? "hsendx" : "hsend";
  check_handler(call, handler);
  const Outgoing message = check_send(*this, call, type, buffer, length, node, pid);
  Request& request = checked(call, requests_.acquire(call));
  start_send(message, request);
  leave_to(handler, request);
}

void Process::hrecv(long typesel, void* buffer, long length, long node, long pid, const Handler& handler) {
  const char* call = handler.extended != nullptr ? "hrecvx" : "hrecv";
  check_handler(call, handler);
  const Selection selection = check_selection(*this, call, typesel, node, pid);
  const ReceiveBuffer into = check_receive_buffer(*this, call, buffer, length);
  Request& request = checked(call, requests_.acquire(call));
  start_receive(selection, into, request);
  leave_to(handler, request);
}

void Process::hsendrecv(long type, const void* out, long out_length, long node, long pid, long typesel, void* in,
                        long in_length, const Handler& handler) {
  check_handler("hsendrecv", handler);
  const Outgoing message = check_send(*this, "hsendrecv", type, out, out_length, node, pid);
  const Selection selection = check_selection(*this, "hsendrecv", typesel, -1, -1);
  const ReceiveBuffer into = check_receive_buffer(*this, "hsendrecv", in, in_length);
  Request& answer = checked("hsendrecv", requests_.acquire("hsendrecv"));
  start_exchange(message, selection, into, answer);
  leave_to(handler, answer);
}

void Process::check_handler(const char* call, const Handler& handler) const {
  if (handler) return;
  fail(call, kNullBuffer, "the handler is a null pointer", "give a function");
}

bool Process::masktrap(bool masked) {
  const bool before = handlers_.mask(masked);
  attend();
  return before;
}

void Process::flick() {
  attend();
  let_pass(quiet_turns_++, kFlick);
}

// Only strict ranks compare their counts. Messages of the program before are counted as its own.
void Process::reset_peer(int rank) {
  if (!rendezvous_.strict()) return;
  while (arrive()) {
  }
  ledger_.forget(rank);
}

void Process::send_internal(int to, const void* data, std::size_t length) {
  const Envelope sent{to, kFirstInternalType + backend_.rank(), length};
  const double begin = ledger_.begin();
  const std::optional<Ticket> ticket = backend_.send_or_start(to, sent.type, data, length);
  ledger_.sent(sent, begin);
  if (ticket) wait_sent(*ticket);
}

std::size_t Process::receive_internal(const char* call, int from, void* data, std::size_t length) {
  const Selection selection{kFirstInternalType + from, from};
  const Envelope before = info_;
  try {
    receive_now(call, selection, {data, length}, nullptr);
  } catch (const CallFailure& failure) {
    Message* too_long = matching_.find(selection);
    if (failure.code != kMessageTooLong || too_long == nullptr) throw;
    info_ = too_long->envelope;
    matching_.remove(too_long);
    drop(too_long);
  }
  const std::size_t came = info_.length;
  info_ = before;
  return came;
}

Ticket Process::start_internal(int to, const void* data, std::size_t length) {
  const Envelope sent{to, kFirstInternalType + backend_.rank(), length};
  const double begin = ledger_.begin();
  const Ticket ticket = backend_.start_send(to, sent.type, data, length);
  ledger_.sent(sent, begin);
  return ticket;
}

bool Process::reduce(const Reduction& reduction, void* x, std::size_t n) {
  const std::optional<Ticket> ticket = backend_.start_reduce(reduction, x, n);
  if (ticket) wait_sent(*ticket);
  return ticket.has_value();
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

}  // namespace mars::messages
