// One rank's message passing: the semantics of NX (nx/) over any backend. A process belongs to the thread
// that made it, and the NX calls of that thread are calls on it; so ranks may be threads or processes. All
// progress happens inside calls: a message waits in the backend until a call looks, and then goes straight
// into the buffer of the receive that it matches, or into the queue of unexpected messages. Once warm,
// nothing is allocated. Failures name node, call, what and remedy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/backend.h"
#include "hal/message_pool.h"
#include "hal/recorder.h"
#include "hal/requests.h"

namespace mars::hal {

// What a process has sent, messages inside collectives included.
struct Traffic {
  struct Count {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
  };
  Count to_nodes;
  Count to_host;
};

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
  long isend(long type, const void* buffer, long length, long node, long pid);
  long irecv(long typesel, void* buffer, long length);
  void msgwait(long mid);
  bool msgdone(long mid);
  void cprobe(long typesel);
  bool iprobe(long typesel);
  const Envelope& info() const { return info_; }
  void flick();
  void led(bool on) { led_ = on; }
  bool led() const { return led_; }

  // For collectives, which are named `call`: one internal message from node to node; exactly `length` bytes
  // must come.
  void send_internal(int to, const void* data, std::size_t length);
  void receive_internal(const char* call, int from, void* data, std::size_t length);

  // The orderly end: waits for all ranks, throws away what nobody received.
  void finish();

  // Throws this process's CallFailure: "node 3, csend: ..."; `code` is one of nx_errno.h.
  [[noreturn]] void fail(const char* call, int code, const std::string& what, const std::string& remedy) const;

  Backend& backend() { return backend_; }
  const Traffic& traffic() const { return traffic_; }

  // Whoever records this process, or nullptr; set by the Recorder.
  Recorder* recorder() const { return recorder_; }
  void record(Recorder* recorder) { recorder_ = recorder; }

 private:
  // Ranks [first, last), without this one if it is one of several.
  struct Receivers {
    int first;
    int last;
    bool several;
  };

  Receivers check_send(const char* call, long type, const void* buffer, long length, long node,
                       long pid) const;
  std::int32_t check_typesel(const char* call, long typesel) const;
  std::size_t check_buffer(const char* call, const void* buffer, long length) const;
  void check_fits(const Request& request, const Envelope& envelope) const;

  // How many messages went to and came from one rank.
  struct Numbers {
    std::uint32_t sent = 0;
    std::uint32_t taken = 0;
  };

  // The time where somebody records it, else 0.
  double recorded_time() const;
  void note_sent(int to, int type, std::size_t length, double begin);
  void send(const Receivers& receivers, int type, const void* data, std::size_t length);

  Request& new_request(const char* call);
  Request& known_request(const char* call, long mid);
  Request& receive(const char* call, std::int32_t typesel, void* buffer, std::size_t length);
  bool done(Request& request);
  void conclude(Request& request);
  void wait(Request& request);
  void note_wait(const Envelope& came, double begin);

  bool look(std::int32_t typesel);
  bool arrive();
  void settle(const Envelope& next);
  void receive_into(Request& request, const Envelope& envelope);
  void keep(const Envelope& envelope);
  void discard(const Envelope& envelope);
  void take(const Envelope& envelope, void* buffer);

  Backend& backend_;
  MessagePool pool_;
  MessageList unexpected_;  // in order of arrival
  RequestTable requests_;
  Envelope info_;
  Traffic traffic_;
  std::vector<Numbers> numbers_;  // by rank
  Recorder* recorder_ = nullptr;
  bool led_ = false;
  int quiet_turns_ = 0;  // flicks since anything arrived
};

// The calling thread's process; a Failure when it has none.
Process& process();

// Where a thread has none, `find` is asked from now on: for C programs, whose first call makes them a rank.
using FindProcess = Process& (*)();
void find_process_by(FindProcess find);

// "node 3" or "the host".
std::string rank_name(int rank, int host);

// What the calling process has sent so far.
const Traffic& traffic();

}  // namespace mars::hal
