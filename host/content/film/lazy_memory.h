// Memory for films of gigabytes: what is reserved costs nothing until it is written, what is resized is not
// cleared, and it comes in large pages where the system has them. It may lie in a file, for films of which little is
// looked at.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace mars::film {

// Pages of memory alone; or, where `in_file`, of a temporary file without a name on a disk that has room for them. The
// latter becomes false where there is none.
void* map_pages(std::size_t bytes, bool& in_file);

template <typename T>
struct LazyMemory {
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  static constexpr std::size_t kMapped = std::size_t{4} << 20;  // bytes from which pages are taken by themselves

  bool in_file = false;

  LazyMemory() = default;
  explicit LazyMemory(bool wants_file) : in_file(wants_file) {}
  template <typename U>
  explicit LazyMemory(const LazyMemory<U>& other) : in_file(other.in_file) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kMapped) return static_cast<T*>(::operator new (bytes, std::align_val_t{alignof(T)}));
    return static_cast<T*>(map_pages(bytes, in_file));
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

  // Any of them can let go of what another has taken.
  bool operator==(const LazyMemory&) const { return true; }
};

template <typename T>
using LazyVector = std::vector<T, LazyMemory<T>>;

// Takes the pages out of memory if they lie in a file, from which they come back where they are looked at again; other
// threads may be at work on them.
template <typename T>
void let_pages_go(const LazyVector<T>& items) {
  const std::size_t bytes = items.capacity() * sizeof(T);
  if (items.get_allocator().in_file && bytes >= LazyMemory<T>::kMapped)
    madvise(const_cast<T*>(items.data()), bytes, MADV_DONTNEED);
}

}  // namespace mars::film
