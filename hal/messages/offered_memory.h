// Memory that one rank offers and others of its machine attach, host and nodes alike. Neither call is collective: the
// name travels in any message. The users order writes and reads by messages. For memory that all nodes of a machine
// make together see shared_memory.h.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "hal/messages/offer.h"

namespace mars::messages {

// `bytes` zeroed bytes, aligned to a page, of which the machine gives pages as they are first touched. Others can
// attach them as long as this lives; nobody can where the machine lets no process share memory. Throws Failure where it
// does not give that much.
class OfferedMemory {
 public:
  explicit OfferedMemory(std::size_t bytes);

  std::span<std::byte> bytes() const { return {offer_.block.get(), size_}; }
  const MemoryName& name() const { return offer_.name; }
  // As PrivateMemory's. Each rank asks for itself.
  void prefer_large_pages();

 private:
  Offer offer_;
  std::size_t size_;
};

// Another rank's memory, or the caller's own: seen as long as this lives, even if that rank has let it go or ended.
class AttachedMemory {
 public:
  // None where the caller cannot see it: the rank is on another machine, the machine keeps their processes apart, or
  // `name` is not of memory of that rank and size. Any bytes are safe as a name.
  static std::optional<AttachedMemory> attach(int rank, const MemoryName& name, std::size_t bytes);

  std::span<std::byte> bytes() const { return {block_.get(), size_}; }

 private:
  AttachedMemory(std::shared_ptr<std::byte> block, std::size_t size) : block_(std::move(block)), size_(size) {}

  std::shared_ptr<std::byte> block_;
  std::size_t size_;
};

}  // namespace mars::messages
