// One rank's message passing: the semantics of NX (nx/) over any backend. A process belongs to the thread
// that made it, and the NX calls of that thread are calls on it; so ranks may be threads or processes. All
// progress happens inside calls: a message waits in the backend until a call looks, and then goes straight
// into the buffer of the receive that it matches, or into the queue of messages that wait. Once warm, nothing
// is allocated. Failures name node, call, what and remedy. process.cpp is the calls, progress.cpp what moves.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hal/arguments.h"
#include "hal/backend.h"
#include "hal/collectives.h"
#include "hal/handlers.h"
#include "hal/ledger.h"
#include "hal/matching.h"
#include "hal/message_pool.h"
#include "hal/rendezvous.h"
#include "hal/requests.h"

namespace mars::hal {

class Files;

class Process {
 public:
  // Makes the calling thread this rank, until destroyed by the same thread; `backend` outlives it.
  explicit Process(Backend& backend);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // As in nx_messages.h.
  void csend(long type, const void* buffer, long length, long node, long pid);
  void crecv(long typesel, void* buffer, long length);
  long csendrecv(long type, const void* out, long out_length, long node, long pid, long typesel, void* in,
                 long in_length);
  long isend(long type, const void* buffer, long length, long node, long pid);
  long irecv(long typesel, void* buffer, long length);
  long isendrecv(long type, const void* out, long out_length, long node, long pid, long typesel, void* in,
                 long in_length);
  void msgwait(long mid);
  bool msgdone(long mid);
  void msgcancel(long mid);
  void cprobe(long typesel);
  bool iprobe(long typesel);
  void flushmsg(long typesel, long node, long pid);
  const Envelope& info() const { return info_; }
  void hsend(long type, const void* buffer, long length, long node, long pid, const Handler& handler);
  void hrecv(long typesel, void* buffer, long length, long node, long pid, const Handler& handler);
  void hsendrecv(long type, const void* out, long out_length, long node, long pid, long typesel, void* in,
                 long in_length, const Handler& handler);
  bool masktrap(bool masked);
  void flick();
  void led(bool on) { led_ = on; }
  bool led() const { return led_; }

  // As in nx_paragon.h.
  void crecvx(long typesel, void* buffer, long length, long node, long pid, long* info);
  long irecvx(long typesel, void* buffer, long length, long node, long pid, long* info);
  void cprobex(long typesel, long node, long pid, long* info);
  bool iprobex(long typesel, long node, long pid, long* info);
  long msgmerge(long mid1, long mid2);
  void msgignore(long mid);

  // The calling thread's NX calls are this process's too, from now on: progress_thread.h.
  void serve_this_thread();

  // Calls the handlers that are due; what else has arrived goes where it belongs.
  void attend();

  // Sends of more than 100 bytes are done only when received: rendezvous.h. Before the first message.
  void be_strict(std::chrono::milliseconds patience) { rendezvous_.be_strict(patience); }

  // For collectives, which are named `call`: one internal message from node to node. How many bytes came is
  // returned; more than `length` are thrown away.
  void send_internal(int to, const void* data, std::size_t length);
  std::size_t receive_internal(const char* call, int from, void* data, std::size_t length);
  // Likewise, behind the first `at` bytes of `room`, which grows as needed.
  std::size_t receive_internal(const char* call, int from, std::vector<std::byte>& room, std::size_t at);
  // As send_internal, but `data` stays untouched until wait_sent.
  Ticket start_internal(int to, const void* data, std::size_t length);
  void wait_sent(Ticket ticket);

  // What the collectives of this process use; the same on all nodes.
  void collectives_by(Collectives means) { collectives_ = means; }
  Collectives collectives() const { return collectives_; }

  // By the network's own means, see backend.h; false where it has none.
  bool reduce(const Reduction& reduction, void* x, std::size_t n);
  bool all_to_all(const void* out, std::span<const Stretch> to, void* in, std::span<const Stretch> from);

  // The orderly end: waits for all ranks, throws away what nobody received.
  void finish();

  // Throws this process's CallFailure: "node 3, csend: ..."; `code` is one of nx_errno.h.
  [[noreturn]] void fail(const char* call, int code, const std::string& what, const std::string& remedy) const;

  // Made with the first call for them (files.h); their end is that of all transfers.
  Files& files();
  void end_files();

  Backend& backend() const { return backend_; }
  const Traffic& traffic() const { return ledger_.traffic(); }

  // Whoever records this process, or nullptr; set by the Recorder.
  Recorder* recorder() const { return ledger_.recorder(); }
  void record(Recorder* recorder) { ledger_.record(recorder); }

 private:
  // For calls named `call`.
  void send_now(const char* call, const Outgoing& message);
  void send_copies(const Outgoing& message, Request* strict);
  void start_send(const Outgoing& message, Request& request);
  void receive_now(const char* call, const Selection& selection, const Room& room, long* info);
  std::size_t receive_internal(const char* call, const Selection& selection, const Room& room, Message*& too_long);
  bool receive_soon(const Selection& selection, const Room& room, long* info);
  void settle_overtaken();
  void start_receive(const Selection& selection, const Room& room, Request& request);
  void start_exchange(const Outgoing& message, const Selection& selection, const Room& room, Request& answer);
  void probe(const char* call, const Selection& selection, long* info);
  bool probe_once(const Selection& selection, long* info);

  // Requests, with those merged with them.
  Request& checked(const char* call, Request* request) const;
  Request& known_request(const char* call, long mid);
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

  void check_handler(const char* call, const Handler& handler) const;
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
  Collectives collectives_ = Collectives::automatic;
  std::unique_ptr<Files> files_;
  bool led_ = false;
  bool overtaken_ = false;  // messages may wait that came before one that was received
  int quiet_turns_ = 0;  // flicks since anything arrived
};

// The calling thread's process; a Failure when it has none.
Process& process();

// Where a thread has none, `find` is asked from now on: for C programs, whose first call makes them a rank.
using FindProcess = Process& (*)();
void find_process_by(FindProcess find);

// By the clock of the calling thread's process; the machine's where it has none.
double seconds();

// "node 3" or "the host".
std::string rank_name(int rank, int host);

// What the calling process has sent so far.
const Traffic& traffic();

}  // namespace mars::hal
