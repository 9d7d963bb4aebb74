// A buffer for any message that is not announced (announcement.h), so that a receive can be posted before the
// length is known and still never cuts. It is address space: memory is taken only as far as messages reach.
#pragma once

#include <cstddef>

namespace mars::mpi {

class Overflow {
 public:
  Overflow();
  ~Overflow();
  Overflow(const Overflow&) = delete;
  Overflow& operator=(const Overflow&) = delete;

  // nullptr where the system has not that much address space.
  std::byte* bytes() const { return bytes_; }
  // Gives memory back after a message of `length`.
  void trim(std::size_t length);

 private:
  std::byte* bytes_ = nullptr;
};

}  // namespace mars::mpi
