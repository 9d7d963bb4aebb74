#include "hal/messages/pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>

#include "hal/failure/explain.h"

namespace mars::messages {
namespace {

bool twice_fits(std::size_t bytes) {
  if (bytes > SIZE_MAX / 2) return false;
  void* addresses = mmap(nullptr, 2 * bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (addresses == MAP_FAILED) return false;
  munmap(addresses, 2 * bytes);
  return true;
}

// About the whole pages.
void advise(std::span<std::byte> block, int advice) {
  void* first = block.data();
  std::size_t left = block.size();
  constexpr std::size_t kPage = 4096;
  if (std::align(kPage, kPage, first, left) != nullptr) madvise(first, left / kPage * kPage, advice);
}

}  // namespace

std::shared_ptr<std::byte> map_pages(std::size_t bytes, std::optional<int> file) {
  const std::size_t size = std::max<std::size_t>(bytes, 1);
  if (!twice_fits(size)) return nullptr;
  const int kind = file ? MAP_SHARED : MAP_PRIVATE | MAP_ANONYMOUS;
  void* block = mmap(nullptr, size, PROT_READ | PROT_WRITE, kind | MAP_NORESERVE, file.value_or(-1), 0);
  if (block == MAP_FAILED) return nullptr;
  return {static_cast<std::byte*>(block), [size](std::byte* old) { munmap(old, size); }};
}

// The machine need not.
void prefer_large_pages(std::span<std::byte> block) { advise(block, MADV_HUGEPAGE); }

void give_pages_back(std::span<std::byte> bytes) { advise(bytes, MADV_DONTNEED); }

Failure too_much_to_share(std::size_t bytes, const std::string& where) {
  return within_limits("the nodes of a machine cannot share " + std::to_string(bytes) + " bytes", where,
                       "use a machine with more memory, a smaller film or a smaller picture");
}

}  // namespace mars::messages
