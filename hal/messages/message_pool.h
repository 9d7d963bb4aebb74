// Buffers for messages on their way, used again and again so that steady traffic allocates nothing: a
// pool retains what it ever allocated, in classes of size 2^k, until it is destroyed. A pool, its lists and
// its messages belong to one thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "hal/messages/backend.h"

namespace mars::messages {

// An envelope, and behind it as many bytes as it says or more.
struct alignas(64) Message {
  Message* next = nullptr;  // in the list it is in
  Envelope envelope;
  int size_class = 0;
  Ticket ticket = kNoTicket;  // of bytes that are still to come
  std::uint32_t number = 0;   // among all from its sender, where a receiver stores it
  std::uint64_t arrival = 0;  // among all of the receiver's

  std::byte* bytes() { return reinterpret_cast<std::byte*>(this + 1); }
};

// First in, first out.
class MessageList {
 public:
  bool empty() const { return first_ == nullptr; }
  Message* front() const { return first_; }
  void push(Message* message);
  // Where its arrival belongs, in a list that is in order of arrival.
  void insert(Message* message);
  Message* pop();
  // Takes all of `other`'s.
  void append(MessageList& other);

  // The first whose envelope is `selected`, or nullptr.
  template <class Selected>
  Message* find(Selected selected) const {
    for (Message* at = first_; at != nullptr; at = at->next) {
      if (selected(at->envelope)) return at;
    }
    return nullptr;
  }
  void remove(Message* message);

 private:
  Message* first_ = nullptr;
  Message* last_ = nullptr;
};

class MessagePool {
 public:
  // Has some of every usual size: how many are needed at once varies with timing, and so would come late.
  MessagePool();

  // A message with `envelope` and as many bytes; give it back by release. Throws std::bad_alloc.
  Message* acquire(const Envelope& envelope);
  // As acquire(), with a copy of the bytes at `data`.
  Message* copy(const Envelope& envelope, const void* data);
  void release(Message* message);

 private:
  struct FreeSlab {
    void operator()(std::byte* slab) const { ::operator delete(slab, std::align_val_t(alignof(Message))); }
  };
  void grow(int size_class);

  std::array<Message*, 48> free_{};  // by size class, last given back first
  std::vector<std::unique_ptr<std::byte, FreeSlab>> slabs_;
};

}  // namespace mars::messages
