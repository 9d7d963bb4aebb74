#include "hal/mpi/overflow.h"

#include <sys/mman.h>

#include <climits>

namespace mars::mpi {
namespace {

constexpr std::size_t kCapacity = INT_MAX;
constexpr std::size_t kRetained = 64 * 1024;  // bytes whose memory stays

}  // namespace

Overflow::Overflow() {
  void* block = mmap(nullptr, kCapacity, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (block != MAP_FAILED) bytes_ = static_cast<std::byte*>(block);
}

Overflow::~Overflow() {
  if (bytes_ != nullptr) munmap(bytes_, kCapacity);
}

void Overflow::trim(std::size_t length) {
  if (length > kRetained) madvise(bytes_ + kRetained, length - kRetained, MADV_DONTNEED);
}

}  // namespace mars::mpi
