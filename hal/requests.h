// What the message ids of one process stand for: sends and receives under way. Ids are 31 bits, as Fortran's
// integers; one that is used after its end is found out. Requests are used again, so that steady traffic
// allocates nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "hal/backend.h"

namespace mars::hal {

struct Request {
  enum class State { free, sending, receiving, sent, received };

  State state = State::free;
  int slot = 0;
  int uses = 0;           // how often the slot was given out
  const char* call = "";  // the NX call that made it

  Ticket ticket = 0;  // of a send under way

  std::int32_t typesel = 0;  // of a receive
  void* buffer = nullptr;
  std::size_t capacity = 0;
  Envelope envelope;  // of what was received

  long mid() const;
};

class RequestTable {
 public:
  // A request with an id of its own, or nullptr when all ids are in use.
  Request* acquire(const char* call);
  // The request that `mid` stands for, or nullptr.
  Request* find(long mid);
  void release(Request& request);

  // Receives that wait for their message, in order of posting.
  void post(Request& request) { posted_.push_back(&request); }
  void unpost(const Request& request);
  // The first posted receive that selects `type`, or nullptr.
  Request* posted_for(std::int32_t type) const;

 private:
  void grow();

  std::deque<Request> requests_;  // by slot
  std::vector<int> free_;         // slots
  std::vector<Request*> posted_;
};

}  // namespace mars::hal
