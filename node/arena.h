// A node's memory for one frame: one block, set aside when a film is loaded, handed out front to back and
// taken back whole. Nothing is allocated while frames are drawn.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace mars::node {

class Arena {
 public:
  Arena() = default;
  // `bytes` of address space; the machine gives pages as they are first touched. Throws Failure.
  explicit Arena(std::size_t bytes);

  // `count` uninitialised items; check()s that they fit: callers plan first.
  template <typename T>
  std::span<T> take(std::size_t count) {
    return {reinterpret_cast<T*>(take_bytes(count * sizeof(T))), count};
  }
  // All that could be taken now, not yet taken: whoever does not know how much it needs fills it from the front
  // and then takes that much.
  template <typename T>
  std::span<T> rest() const {
    return {reinterpret_cast<T*>(block_.get() + used_), (size_ - used_) / sizeof(T)};
  }

  std::size_t mark() const { return used_; }
  void release(std::size_t mark) { used_ = mark; }  // frees what was taken since mark()

  std::size_t size() const { return size_; }
  std::size_t fullest() const { return fullest_; }  // most bytes in use since forget_fullest()
  void forget_fullest() { fullest_ = used_; }

 private:
  std::byte* take_bytes(std::size_t bytes);

  std::unique_ptr<std::byte[]> block_;
  std::size_t size_ = 0;
  std::size_t used_ = 0;
  std::size_t fullest_ = 0;
};

}  // namespace mars::node
