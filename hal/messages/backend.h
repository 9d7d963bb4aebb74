// The contract of transports: what a process (process.h) asks of a backend. hal/mpi/, hal/processes/ and hal/threads/
// implement it; hal/template/ is one to copy. One Backend object is one rank; all its calls come from one thread. Ranks
// are the nodes 0..nodes()-1 and the host, whose id is nodes(). Types are 0..2^31-1 and lengths bytes; what types mean
// does not concern a backend. Between one sender and one receiver messages arrive in the order sent.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "hal/messages/neighbourhood.h"
#include "hal/messages/offer.h"

namespace mars::messages {

class MessagePool;

struct Envelope {
  int from = 0;
  int type = 0;
  std::size_t length = 0;
};

// Reductions that a network may offer.
struct Reduction {
  enum class Element { real64, real32, whole };
  enum class Rule { sum, product, high, low, bit_and, bit_or, bit_xor };

  Element element;
  Rule rule;
};

// Names a send that start_send began, or a receive that start_take began, until `sent` has said true.
using Ticket = int;
inline constexpr Ticket kNoTicket = -1;

inline double machine_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class Backend {
 public:
  virtual ~Backend() = default;

  virtual int rank() const = 0;
  virtual int nodes() const = 0;
  int host() const { return nodes(); }
  // False where there is none: nothing is sent to its id then.
  virtual bool has_host() const { return true; }

  // Sends a copy: `data` may be used again on return. Never waits for the receiver. `to` may be this rank.
  virtual void send(int to, int type, const void* data, std::size_t length) = 0;

  // As send; or, where the backend knows that the receiver waits for just this message, as start_send.
  virtual std::optional<Ticket> send_or_start(int to, int type, const void* data, std::size_t length) {
    send(to, type, data, length);
    return std::nullopt;
  }

  // Starts to send without a copy where the backend can: `data` stays untouched until sent(ticket), which
  // then frees the ticket. Neither waits.
  virtual Ticket start_send(int to, int type, const void* data, std::size_t length) = 0;
  virtual bool sent(Ticket ticket) = 0;

  // The next arrived message, if there is one; the same until it is taken.
  virtual std::optional<Envelope> peek() = 0;
  // Takes the message that peek returned into `buffer`, which is at least its length.
  virtual void take(void* buffer) = 0;
  // As take; or, where the message's bytes are still on their way and the backend can receive them meanwhile, begins
  // to: `buffer` is the backend's until sent(ticket). It does not wait for the sender then.
  virtual std::optional<Ticket> start_take(void* buffer) {
    take(buffer);
    return std::nullopt;
  }

  // For a caller that waits for a message of just this type while peek has nothing: waits some microseconds and takes
  // it if it comes and is at most `capacity` long: true, and `came` is its envelope. Other messages may be overtaken.
  virtual bool receive_soon(int /*type*/, void* /*buffer*/, std::size_t /*capacity*/, Envelope& /*came*/) {
    return false;
  }

  // A reduction of all nodes by the network's own means, where it has it: done when sent(ticket). In place, element by
  // element; `x` stays untouched until then.
  virtual std::optional<Ticket> start_reduce(const Reduction& /*reduction*/, void* /*x*/, std::size_t /*n*/) {
    return {};
  }

  // Called between unsuccessful looks, turn 0, 1, 2 ...: lets time pass, longer with each turn, at most about
  // `longest`, and not beyond an event that the backend can see. A caller that gives 5 ms or more has
  // nothing to do before a message comes: where all ranks do so, a backend may end the job.
  virtual void idle(int turn, std::chrono::microseconds longest) = 0;

  // Since some fixed point: by the machine's clock, unless ranks live by another.
  virtual double seconds() const { return machine_seconds(); }
  // Whether it is that of the machine.
  virtual bool has_machine_clock() const { return true; }
  // The rank has just done `units` of a kind of work, by the program's own numbers: where ranks live by another
  // clock, it goes on by what they cost.
  virtual void charge(int /*kind*/, std::uint64_t /*units*/) {}
  // From now on the rank waits for messages of ranks [first, first + count) alone, itself among them: what others do
  // in the meantime, the host too, does not matter to it. All nodes: it waits for anybody's.
  virtual void keep_to(int /*first*/, int /*count*/) {}
  // Nobody will read these bytes before they are written again: the machine may have their pages back.
  virtual void discard(std::span<std::byte> /*bytes*/) {}
  // Where ranks never run at the same time they may have one pool for all of them; nullptr: each has its own.
  virtual MessagePool* pool() { return nullptr; }

  // All nodes of this node's machine.
  virtual Neighbourhood neighbourhood() = 0;
  // Collective over the nodes of one machine: see SharedMemory. Of the caller alone where they cannot share memory.
  virtual std::shared_ptr<std::byte> share(std::size_t bytes) = 0;
  // Not collective. Memory into which all ranks write the same, whatever machine they are on, named by `key`: where
  // machines are simulated, there is one for all of them. nullptr: each machine has its own.
  virtual std::shared_ptr<std::byte> replica(std::uint64_t /*key*/, std::size_t /*bytes*/) { return nullptr; }
  // Not collective, and of the host too: see OfferedMemory. Zeroed bytes, aligned to a page; a null block where the
  // machine does not give them.
  virtual Offer offer(std::size_t bytes) = 0;
  // nullptr where they cannot be seen from here, and for any false name: see AttachedMemory.
  virtual std::shared_ptr<std::byte> attach(int rank, const MemoryName& name, std::size_t bytes) = 0;

  // The orderly end: called again and again, with messages taken in between, until it says true: all ranks
  // have come here, and no message is on its way to or from this one. Nothing is sent after the first call.
  virtual bool finish() = 0;

  // `call` is called now and then where a call of the backend itself, such as share, waits for other ranks.
  void while_waiting(std::function<void()> call) { while_waiting_ = std::move(call); }

  // Ends all ranks at once and prints `reason`. Never waits for any of them.
  [[noreturn]] virtual void abort(const std::string& reason) = 0;

 protected:
  std::function<void()> while_waiting_;  // none: nothing is called
};

}  // namespace mars::messages
