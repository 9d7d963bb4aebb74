// One rank's blocks for the messages it sends, in its part of the segment. Blocks of 2^k bytes are used again
// and again, so that steady traffic takes no new memory; more than a share of it that lies idle goes back to
// the system.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/processes/segment.h"

namespace mars::processes {

class Heap {
 public:
  // Rank `index`'s; blocks that an earlier process of this rank has left in use stay so until they are given back.
  Heap(const Segment& segment, int index);
  Heap(const Segment&&, auto&&...) = delete;

  // A block of at least `length` bytes and its length set. Throws Failure when the messages under way take
  // all the memory that they may.
  Offset acquire(std::size_t length);

 private:
  void reclaim();
  void release(Offset offset);
  Offset carve(std::uint32_t size_class);
  void touch(Block& block, std::size_t length);
  void reserve(std::uint64_t bytes);
  [[noreturn]] void fail_full() const;
  void hollow(Block& block, Offset offset);

  const Segment& segment_;
  const int index_;
  Slot& slot_;
  std::uint64_t idle_ = 0;         // bytes of free large blocks that take memory
  std::array<Offset, 48> free_{};  // by size class, last given back first
};

}  // namespace mars::processes
