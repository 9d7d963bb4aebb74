// Numbers from one byte order to another: the work of the calls of nx_byte_order.h.
#pragma once

#include <algorithm>
#include <bit>
#include <span>

namespace mars::nx {

// Host and nodes are machines of this one's kind.
inline constexpr std::endian kHostOrder = std::endian::native;
inline constexpr std::endian kNodeOrder = std::endian::native;

template <class Number>
void reorder(std::span<Number> numbers, std::endian from, std::endian to) {
  if (from == to) return;
  for (Number& number : numbers) std::ranges::reverse(std::as_writable_bytes(std::span(&number, 1)));
}

}  // namespace mars::nx
