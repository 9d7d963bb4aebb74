// All forms of the global operators new and delete, by two functions of the one source of a program that includes this,
// which are declared here.
#pragma once

#include <cstddef>
#include <new>

namespace mars::test {

void* allocate(std::size_t size, std::size_t alignment) noexcept;  // null: there is no memory
void release(void* block) noexcept;

inline void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* const block = allocate(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

inline constexpr std::size_t kUsual = alignof(std::max_align_t);

}  // namespace mars::test

void* operator new(std::size_t size) { return mars::test::allocate_or_throw(size, mars::test::kUsual); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return mars::test::allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return mars::test::allocate(size, mars::test::kUsual);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return mars::test::allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { mars::test::release(block); }
void operator delete(void* block, std::size_t) noexcept { mars::test::release(block); }
void operator delete(void* block, std::align_val_t) noexcept { mars::test::release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { mars::test::release(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { mars::test::release(block); }
void operator delete(void* block, std::align_val_t, const std::nothrow_t&) noexcept { mars::test::release(block); }
