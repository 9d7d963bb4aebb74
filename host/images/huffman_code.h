// Huffman codes as DEFLATE has them (RFC 1951, 3.2.2): canonical, given by the lengths of their words alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace mars::images {

struct HuffmanCode {
  // The word of each symbol, its first bit lowest, and its length in bits; 0: the symbol has none.
  std::vector<std::uint32_t> words;
  std::vector<std::uint8_t> lengths;
};

// For symbols with these counts, with words of at most `longest` bits (1..15, and enough for the symbols
// that occur). One symbol alone has a word of one bit.
HuffmanCode huffman_code(std::span<const std::uint32_t> counts, std::uint32_t longest);

}  // namespace mars::images
