// Memory of one node alone, in large blocks that last.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace mars::messages {

class PrivateMemory {
 public:
  PrivateMemory() = default;
  // `bytes` zeroed bytes, aligned to a page; the machine gives pages as they are first touched, near to the processor
  // that touches them. Throws Failure.
  explicit PrivateMemory(std::size_t bytes);

  // Lets the machine give large pages (2 MiB), where it has them: for memory that is used from end to end.
  void prefer_large_pages();

  std::span<std::byte> bytes() const { return {block_.get(), block_.get_deleter().size}; }

 private:
  struct Release {
    std::size_t size;
    void operator()(std::byte* block) const;
  };
  std::unique_ptr<std::byte, Release> block_;
};

}  // namespace mars::messages
