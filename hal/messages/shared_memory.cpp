#include "hal/messages/shared_memory.h"

#include "hal/messages/pages.h"
#include "hal/messages/process.h"

namespace mars::messages {

Neighbourhood neighbourhood() {
  Neighbourhood here = machine_neighbourhood();
  if (here.refusal.empty()) return here;
  here.machine = process().backend().rank();
  here.index = 0;
  here.count = 1;
  return here;
}

Neighbourhood machine_neighbourhood() { return process().backend().neighbourhood(); }

SharedMemory::SharedMemory(std::size_t bytes) : block_(process().backend().share(bytes)), size_(bytes) {}

SharedMemory::SharedMemory(std::uint64_t key, std::size_t bytes) : block_(replica(key, bytes)), size_(bytes) {
  if (block_ == nullptr) block_ = process().backend().share(bytes);
}

std::shared_ptr<std::byte> replica(std::uint64_t key, std::size_t bytes) {
  return process().backend().replica(key, bytes);
}

void SharedMemory::prefer_large_pages() { messages::prefer_large_pages(bytes()); }

}  // namespace mars::messages
