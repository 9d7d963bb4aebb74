// Message types, and the types that a receive's `typesel` selects, by the rules of NX.
#pragma once

#include <cstdint>

namespace mars::messages {

enum class TypeClass { ordinary, force, reserved };

// Types of MARS's own collectives, one a sender, out of a range NX reserves: no wildcard selects them.
inline constexpr int kFirstInternalType = 1'000'000'000;
inline constexpr int kInternalTypes = 1 << 20;  // and so the most nodes there can be

constexpr TypeClass type_class(std::int64_t type) {
  if (type >= 0 && type <= 999'999'999) return TypeClass::ordinary;
  if (type >= 1'073'741'824 && type <= 1'999'999'999) return TypeClass::force;
  return TypeClass::reserved;
}

// A caller's typesel as NX saw it: 32 bits. Programs write 0x80000007 and mean a negative number.
constexpr std::int32_t narrow_typesel(std::int64_t typesel) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(typesel));
}

// typesel >= 0: exactly that type. Negative: a set of ordinary types; bit k (0..29) is type k, bit 30 all
// types from 30 up; hence -1 is every ordinary type.
constexpr bool selects(std::int32_t typesel, std::int32_t type) {
  if (typesel >= 0) return type == typesel;
  if (type_class(type) != TypeClass::ordinary) return false;
  const int bit = type < 30 ? type : 30;
  return (static_cast<std::uint32_t>(typesel) >> bit & 1u) != 0;
}

}  // namespace mars::messages
