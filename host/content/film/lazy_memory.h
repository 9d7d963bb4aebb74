// Memory for films of gigabytes: what is reserved costs nothing until it is written, what is resized is not
// cleared, and it comes in large pages where the system has them.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace mars::film {

template <typename T>
struct LazyMemory {
  using value_type = T;

  static constexpr std::size_t kMapped = std::size_t{4} << 20;  // bytes from which pages are taken by themselves

  LazyMemory() = default;
  template <typename U>
  explicit LazyMemory(const LazyMemory<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kMapped) return static_cast<T*>(::operator new (bytes, std::align_val_t{alignof(T)}));
    void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    madvise(pages, bytes, MADV_HUGEPAGE);
    return static_cast<T*>(pages);
  }

  void deallocate(T* items, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kMapped)
      ::operator delete (items, std::align_val_t{alignof(T)});
    else
      munmap(items, bytes);
  }

  // Not cleared.
  template <typename U>
  void construct(U* item) {
    ::new (static_cast<void*>(item)) U;
  }
  template <typename U, typename... Values>
  void construct(U* item, Values&&... values) {
    ::new (static_cast<void*>(item)) U(static_cast<Values&&>(values)...);
  }

  bool operator==(const LazyMemory&) const { return true; }
};

template <typename T>
using LazyVector = std::vector<T, LazyMemory<T>>;

}  // namespace mars::film
