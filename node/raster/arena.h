// A node's memory for one frame: one block, set aside when a film is loaded (group/frame_memory.h), handed out from
// both ends and taken back whole. Nothing is allocated while frames are drawn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace mars::raster {

class Arena {
 public:
  Arena() = default;
  // Hands out `block`, which begins at a cache line and outlives it.
  explicit Arena(std::span<std::byte> block);

  // `count` uninitialised items; check()s that they fit: callers plan first.
  template <typename T>
  std::span<T> take(std::size_t count) {
    return {reinterpret_cast<T*>(take_bytes(count * sizeof(T))), count};
  }
  // All that is not taken: a caller that does not know how much it needs fills it from both ends and then takes that
  // many bytes at the front and at the back.
  std::span<std::byte> rest() const { return block_.subspan(front_, back_ - front_); }
  void take_ends(std::size_t at_front, std::size_t at_back);

  void clear() { front_ = 0, back_ = block_.size(), peak_ = 0; }

  std::span<std::byte> all() const { return block_; }
  std::size_t size() const { return block_.size(); }
  std::size_t peak() const { return peak_; }  // most bytes in use since clear()
  // Bytes that were in use for the first time ever since it was asked last.
  std::size_t take_fresh() {
    const std::size_t before = std::exchange(touched_, std::max(touched_, peak_));
    return touched_ - before;
  }

 private:
  // Items begin on multiples of this: a cache line.
  static constexpr std::size_t kGrain = 64;

  std::byte* take_bytes(std::size_t bytes);
  std::size_t used() const { return front_ + (block_.size() - back_); }

  std::span<std::byte> block_;
  std::size_t front_ = 0;
  std::size_t back_ = 0;
  std::size_t peak_ = 0;
  std::size_t touched_ = 0;
};

}  // namespace mars::raster
