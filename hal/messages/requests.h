// Sends and receives under way, and the message ids of one process that stand for them. Ids are 31 bits, as
// Fortran's integers; one that is used after its end is found out. Requests are used again, so that steady
// traffic allocates nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "hal/messages/backend.h"
#include "hal/messages/handler.h"
#include "hal/messages/selection.h"

namespace mars::messages {

struct Message;

// How many ids one process has at once.
inline constexpr int kMessageIds = 1 << 16;

struct Request {
  enum class State {
    free,
    sending,     // its buffer is not yet free
    unreceived,  // it is, but in strict mode the receiver has yet to say that it has the message
    sent,
    receiving,
    coming,  // it has its message, whose bytes are not all here
    received,
    too_long,  // the message did not fit, and went on to the next receive
  };

  State state = State::free;
  int slot = 0;
  int uses = 0;             // how often the slot was given out
  bool has_id = false;      // a message id stands for it
  const char* call = "";    // the NX call that made it
  Request* also = nullptr;  // done only with this one, too
  Handler handler;          // called when done
  Envelope envelope;        // of what was received, or is too long; of a send, whose `from` is the receiver

  Ticket ticket = 0;   // of a send under way, or of bytes that come straight into the buffer
  int unreceived = 0;  // how many receivers have yet to say that they have it

  Selection selection;        // of a receive
  Message* queued = nullptr;  // that comes, if it waited before; nullptr: straight into the buffer
  void* buffer = nullptr;
  std::size_t capacity = 0;
  long* info = nullptr;       // 8 numbers about the message received; nullptr: not wanted
  std::uint64_t arrival = 0;  // of what was received
  std::uint32_t number = 0;   // of what was received

  long mid() const;
};

class RequestTable {
 public:
  // A request, or nullptr when there are too many.
  Request* acquire(const char* call);
  // One that an id stands for, or nullptr when all ids are in use.
  Request* acquire_id(const char* call);
  // Takes the id away.
  void forget_id(Request& request);
  // The request that `mid` stands for, or nullptr.
  Request* find(long mid);
  void release(Request& request);

 private:
  void grow();

  std::deque<Request> requests_;  // by slot
  std::vector<int> free_;         // slots
  int ids_ = 0;                   // in use
};

}  // namespace mars::messages
