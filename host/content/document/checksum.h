// XXH3 with 128 bits, as 32 hexadecimal digits: names the contents of a film or of its frames. The only place
// that knows xxhash. Not for secrets.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace mars::document {

class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(std::span<const std::byte> bytes);
  std::string digits() const;  // of all bytes added so far

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string checksum_of(std::span<const std::byte> bytes);

}  // namespace mars::document
