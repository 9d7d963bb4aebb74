// One rank's message passing: the semantics of NX (hal/nx/) over any backend. A process belongs to the thread
// that made it, and the NX calls of that thread are calls on it; so ranks may be threads or processes. All
// progress happens inside calls: a message waits in the backend until a call looks, and then goes straight
// into the buffer of the receive that it matches, or into the queue of messages that wait. Once warm, nothing
// is allocated. Failures name node, call, what and remedy. process.cpp has the calls, progress.cpp and sending.cpp what
// they share.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "hal/messages/collective_method.h"
#include "hal/messages/progress.h"

namespace mars::messages {

class Process : public Progress {
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

  // As in nx_paragon.h.
  void crecvx(long typesel, void* buffer, long length, long node, long pid, long* info);
  long irecvx(long typesel, void* buffer, long length, long node, long pid, long* info);
  void cprobex(long typesel, long node, long pid, long* info);
  bool iprobex(long typesel, long node, long pid, long* info);
  long msgmerge(long mid1, long mid2);
  void msgignore(long mid);

  // The calling thread's NX calls are this process's too, from now on: progress_thread.h.
  void serve_this_thread();

  // `call` is called now and then, several times a second, while a call of this process waits: for a message, until its
  // own is gone, for other nodes (global operations, shared memory), or in flick. It may do what a handler may: send,
  // receive what is there, and throw, which ends the call that waits. It must not wait, nor set another. What the
  // waiting call's info* say does not change by it. It is not called in finish, after which nobody receives; nor from
  // within itself; nor on machines whose clock is not the machine's, which are simulated. An empty one: none.
  using Progress::while_waiting;

  // Sends of more than 100 bytes are done only when received: rendezvous.h. Before the first message.
  void set_strict(std::chrono::milliseconds patience) { rendezvous_.set_strict(patience); }

  // Another program is about to run as `rank`, and counts its messages from the first.
  void reset_peer(int rank);

  // For collectives, which are named `call`: one internal message from node to node. Returns how many bytes came; if
  // more than `length`, they are discarded.
  void send_internal(int to, const void* data, std::size_t length);
  std::size_t receive_internal(const char* call, int from, void* data, std::size_t length);
  // As send_internal, but `data` stays untouched until wait_sent.
  Ticket start_internal(int to, const void* data, std::size_t length);
  using Progress::wait_sent;

  // The method of this process's collectives; the same on all nodes.
  void set_collectives(CollectiveMethod method) { collectives_ = method; }
  CollectiveMethod collectives() const { return collectives_; }

  // By the network's own means, see backend.h; false where it has none.
  bool reduce(const Reduction& reduction, void* x, std::size_t n);

  // The orderly end: waits for all ranks, discards messages that were not received.
  void finish();

  // State that a layer above has for this process. It is destroyed with the process, or when another replaces it.
  class Extension {
   public:
    virtual ~Extension() = default;
  };
  Extension* extension() const { return extension_.get(); }
  void extend(std::unique_ptr<Extension> extension) { extension_ = std::move(extension); }

  const Traffic& traffic() const { return ledger_.traffic(); }

  // The recorder of this process, or nullptr; set by Recorder.
  EventBuffer* recorder() const { return ledger_.recorder(); }
  void record(EventBuffer* recorder) { ledger_.record(recorder); }

 private:
  void start_exchange(const Outgoing& message, const Selection& selection, const ReceiveBuffer& into, Request& answer);
  Request& known_request(const char* call, long mid);
  void check_handler(const char* call, const Handler& handler) const;

  CollectiveMethod collectives_ = CollectiveMethod::automatic;
  std::unique_ptr<Extension> extension_;
  bool led_ = false;  // only debuggers read it
};

// The calling thread's process; a Failure when it has none.
Process& process();

// Where a thread has none, `find` is asked from now on: for C programs, whose first call makes them a rank.
using FindProcess = Process& (*)();
void find_process_by(FindProcess find);

// By the clock of the calling thread's process; the machine's where it has none.
double seconds();

// The calling process has done `units` of a kind of work (Backend::charge).
void charge(int kind, std::uint64_t units);

// As the Backend's calls of the same names.
void keep_to(int first, int count);
void keep_to_nobody();
void discard(std::span<std::byte> bytes);

// The messages that the calling process has sent so far.
const Traffic& traffic();

}  // namespace mars::messages
