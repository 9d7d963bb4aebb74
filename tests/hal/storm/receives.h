// The posted receives of one rank of a storm, irecv's and hrecv's, in order of posting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <vector>

#include "tests/hal/storm/ledger.h"

namespace mars::storm {

// The most bytes of a message that `typesel` can select.
std::size_t capacity_for(std::int32_t typesel);

// Buffers of one rank. Long ones are few and used again: to get one costs much under a sanitizer.
class Buffers {
 public:
  using Buffer = std::shared_ptr<unsigned char[]>;

  // Of at least `capacity` bytes, with anything in them; nullptr where too many long ones are out.
  Buffer get(std::size_t capacity);

 private:
  std::vector<Buffer> long_;  // those that only it has are free
};

struct Receive {
  Taker taker;
  std::size_t capacity;
  Buffers::Buffer buffer;  // only touched where a message comes
  long mid;                // of an irecv, or -1
  int handler;             // of an hrecv, or -1
  bool fired = false;
  Came came = {};  // once it has
};

using Receives = std::list<Receive>;

// A random typesel that selects something.
std::int32_t any_typesel(Random& random);
// An ordinary or force type that `typesel` selects.
std::int32_t type_for(std::int32_t typesel);

}  // namespace mars::storm
