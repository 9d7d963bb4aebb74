// What moves inside of one rank's message calls (process.h): requests to their end, arrived messages to where they
// belong, handlers when they are due.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "hal/messages/arguments.h"
#include "hal/messages/backend.h"
#include "hal/messages/handlers.h"
#include "hal/messages/ledger.h"
#include "hal/messages/matching.h"
#include "hal/messages/message_pool.h"
#include "hal/messages/rendezvous.h"
#include "hal/messages/requests.h"

namespace mars::hal {

class Progress {
 public:
  // `backend` outlives it.
  explicit Progress(Backend& backend);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Calls the handlers that are due; what else has arrived goes where it belongs.
  void attend();

  // Throws this process's CallFailure: "node 3, csend: ..."; `code` is one of nx_errno.h.
  [[noreturn]] void fail(const char* call, int code, const std::string& what, const std::string& remedy) const;

  Backend& backend() const { return backend_; }

 protected:
  ~Progress() = default;

  // For calls named `call`.
  void send_now(const char* call, const Outgoing& message);
  void send_copies(const Outgoing& message, Request* strict);
  void wait_sent(Ticket ticket);
  void start_send(const Outgoing& message, Request& request);
  void receive_now(const char* call, const Selection& selection, const Room& room, long* info);
  bool receive_soon(const Selection& selection, const Room& room, long* info);
  void settle_overtaken();
  void start_receive(const Selection& selection, const Room& room, Request& request);
  void probe(const char* call, const Selection& selection, long* info);
  bool probe_once(const Selection& selection, long* info);

  // Requests, with those merged with them.
  Request& checked(const char* call, Request* request) const;
  bool done(Request& head);
  bool done_alone(Request& request);
  void wait(Request& head);
  void wait_or_cancel(Request& head);
  bool pass(int& turn);
  void conclude(Request& head);
  void cancel(Request& head);
  void give_back(const Request& request);
  void release(Request& head);
  void mark_too_long(Request& request, const Envelope& envelope);
  [[noreturn]] void fail_too_long(const Request& request) const;

  void leave_to(const Handler& handler, Request& request);
  bool call_handlers();
  void call_handler(Request& head);

  // What has arrived.
  bool look(const Selection& selection);
  bool tell_of(const Message* message);
  bool arrive();
  void settle(const Envelope& next);
  Request* claim(const Envelope& envelope);
  void receive_into(Request& request, const Envelope& envelope);
  void deliver(Message* message, Request& request);
  void keep(const Envelope& envelope);
  void discard(const Envelope& envelope);
  std::uint32_t take(const Envelope& envelope, void* buffer);
  void acknowledge(const Envelope& envelope, std::uint32_t number);

  Backend& backend_;
  const int acknowledgement_;  // the type of internal messages that say: received
  MessagePool pool_;
  Matching matching_;
  RequestTable requests_;
  Handlers handlers_;
  Rendezvous rendezvous_;
  Envelope info_;
  Ledger ledger_;
  bool overtaken_ = false;  // messages may wait that came before one that was received
  int quiet_turns_ = 0;  // flicks since anything arrived
};

// "node 3" or "the host".
std::string rank_name(int rank, int host);

}  // namespace mars::hal
