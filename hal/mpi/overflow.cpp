#include "hal/mpi/overflow.h"

#include <sys/mman.h>

#include <climits>

namespace mars::hal {
namespace {

constexpr std::size_t kRoom = INT_MAX;
constexpr std::size_t kKept = 64 * 1024;  // bytes whose memory stays

}  // namespace

Overflow::Overflow() {
  void* block = mmap(nullptr, kRoom, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (block != MAP_FAILED) bytes_ = static_cast<std::byte*>(block);
}

Overflow::~Overflow() {
  if (bytes_ != nullptr) munmap(bytes_, kRoom);
}

void Overflow::trim(std::size_t length) {
  if (length > kKept) madvise(bytes_ + kKept, length - kKept, MADV_DONTNEED);
}

}  // namespace mars::hal
