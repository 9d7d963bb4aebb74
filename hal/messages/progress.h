// Progress inside one rank's message calls (process.h): requests to their end, arrived messages to their receive or
// queue, handlers when they are due.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "hal/messages/arguments.h"
#include "hal/messages/backend.h"
#include "hal/messages/caller.h"
#include "hal/messages/handler_queue.h"
#include "hal/messages/ledger.h"
#include "hal/messages/matching.h"
#include "hal/messages/message_pool.h"
#include "hal/messages/rendezvous.h"
#include "hal/messages/requests.h"

namespace mars::messages {

class Progress : public Caller {
 public:
  explicit Progress(Backend& backend);

  // As Process's.
  void while_waiting(std::function<void()> call);

  // Calls the handlers that are due; what else has arrived goes where it belongs.
  void attend();

 protected:
  ~Progress() = default;

  // For calls named `call`.
  void send_now(const char* call, const Outgoing& message);
  void send_copies(const Outgoing& message, Request* strict);
  void wait_sent(Ticket ticket);
  void start_send(const Outgoing& message, Request& request);
  void receive_now(const char* call, const Selection& selection, const ReceiveBuffer& into, long* info);
  bool receive_soon(const Selection& selection, const ReceiveBuffer& into, long* info);
  void settle_overtaken();
  void start_receive(const Selection& selection, const ReceiveBuffer& into, Request& request);
  void probe(const char* call, const Selection& selection, long* info);
  bool probe_once(const Selection& selection, long* info);

  // Requests, with those merged with them.
  Request& checked(const char* call, Request* request) const;
  bool done(Request& head);
  bool done_alone(Request& request);
  void wait(Request& head);
  void wait_or_cancel(Request& request);
  bool pass(int& turn);
  bool pass_for(const Request& head, int& turn);
  void let_pass(int turn, std::chrono::microseconds longest);
  void call_while_waiting();
  void conclude(Request& head);
  void cancel(Request& head);
  void give_back(const Request& request);
  void release(Request& head);
  void mark_too_long(Request& request, const Envelope& envelope);
  [[noreturn]] void fail_too_long(const Request& request) const;

  void leave_to(const Handler& handler, Request& request);
  bool call_handlers();
  void call_handler(Request& head);

  // Arrived messages.
  bool look(const Selection& selection);
  bool found(const Message* message);
  bool arrive();
  void settle(const Envelope& next);
  Request* claim(const Envelope& envelope);
  void receive_into(Request& request, const Envelope& envelope);
  void deliver(Message* message, Request& request);
  bool is_here(Message& message);
  bool has_come(Request& request);
  void await_rest(Request& request);
  void drop(Message* message);
  void store(const Envelope& envelope);
  void discard(const Envelope& envelope);
  std::uint32_t take(const Envelope& envelope, void* buffer);
  Ticket start_take(const Envelope& envelope, void* buffer, std::uint32_t& number);
  void acknowledge(const Envelope& envelope, std::uint32_t number);

  const int acknowledgement_;  // the type of internal messages that say: received
  std::unique_ptr<MessagePool> own_pool_;
  MessagePool& pool_;
  Matching matching_;
  RequestTable requests_;
  HandlerQueue handlers_;
  Rendezvous rendezvous_;
  Envelope info_;
  Ledger ledger_;
  bool overtaken_ = false;  // messages may wait that came before one that was received
  int quiet_turns_ = 0;     // flicks since anything arrived

  std::function<void()> while_waiting_;
  bool is_calling_ = false;      // it
  unsigned pauses_to_call_ = 0;  // of waiting, until it is called again
};

}  // namespace mars::messages
