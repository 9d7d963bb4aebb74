#include "hal/messages/offered_memory.h"

#include <string>

#include "hal/failure/explain.h"
#include "hal/messages/pages.h"
#include "hal/messages/process.h"

namespace mars::messages {

OfferedMemory::OfferedMemory(std::size_t bytes) : offer_(process().backend().offer(bytes)), size_(bytes) {
  if (offer_.block == nullptr) offer_ = {{}, map_pages(bytes)};
  if (offer_.block == nullptr)
    throw within_limits("the machine does not give " + std::to_string(bytes) + " bytes that processes can share", "",
                        "use a machine with more memory");
}

void OfferedMemory::prefer_large_pages() { messages::prefer_large_pages(bytes()); }

std::optional<AttachedMemory> AttachedMemory::attach(int rank, const MemoryName& name, std::size_t bytes) {
  std::shared_ptr<std::byte> block = process().backend().attach(rank, name, bytes);
  if (block == nullptr) return std::nullopt;
  return AttachedMemory(std::move(block), bytes);
}

}  // namespace mars::messages
