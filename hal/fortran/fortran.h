// Fortran's calling convention, as the entry points in this folder follow it: every argument by reference, INTEGER*4
// for all integers, names in lower case with an underscore behind, and the lengths of CHARACTER arguments behind all
// others (as gfortran and those that follow it do).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mars::fortran {

using Integer = std::int32_t;
using CharacterLength = std::size_t;

inline Integer narrow(long value) { return static_cast<Integer>(value); }

inline std::vector<long> widen(const Integer values[], long n) { return {values, values + (n > 0 ? n : 0)}; }

// Without the blanks that fill it up.
inline std::string text(const char* characters, CharacterLength length) {
  const std::string_view all(characters, length);
  return std::string(all.substr(0, all.find_last_not_of(' ') + 1));
}

}  // namespace mars::fortran
