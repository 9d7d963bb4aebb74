// The posted receives of one rank of a storm, irecv's and hrecv's, in order of posting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

#include "tests/hal/storm/ledger.h"

namespace mars::hal::storm {

// The most bytes of a message that `typesel` can select.
std::size_t room_for(std::int32_t typesel);

struct Receive {
  Receive(long order, std::int32_t typesel)
      : taker{order, typesel},
        room(room_for(typesel)),
        buffer(std::make_unique_for_overwrite<unsigned char[]>(room)) {}

  Taker taker;
  std::size_t room;
  std::unique_ptr<unsigned char[]> buffer;  // only touched where a message comes
  long mid = -1;                            // of an irecv
  int handler = -1;                         // of an hrecv
  bool fired = false;
  Came came = {};  // once it has
};

using Receives = std::list<Receive>;

// A random typesel that selects something.
std::int32_t any_typesel(Random& random);
// An ordinary or force type that `typesel` selects.
std::int32_t type_for(std::int32_t typesel);

}  // namespace mars::hal::storm
