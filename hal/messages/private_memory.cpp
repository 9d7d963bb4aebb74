#include "hal/messages/private_memory.h"

#include <sys/mman.h>

#include <string>

#include "hal/failure/explain.h"
#include "hal/messages/pages.h"

namespace mars::messages {

PrivateMemory::PrivateMemory(std::size_t bytes) {
  if (bytes == 0) return;
  void* block = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED)
    throw within_limits("the machine does not give a node " + std::to_string(bytes >> 20) + " MiB", "memory",
                        "start fewer nodes a machine, render a smaller picture, or set MARS_MEMORY to fewer MiB");
  block_ = {static_cast<std::byte*>(block), Release{bytes}};
}

void PrivateMemory::prefer_large_pages() { messages::prefer_large_pages(bytes()); }

void PrivateMemory::Release::operator()(std::byte* block) const { munmap(block, size); }

}  // namespace mars::messages
