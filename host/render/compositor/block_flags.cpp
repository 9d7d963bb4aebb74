#include "host/render/compositor/block_flags.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::compositor {

namespace {

std::uint32_t blocks_over(std::uint32_t pixels, std::uint32_t block) { return pixels / block + (pixels % block != 0); }

// Bits [first, 64) of a word.
std::uint64_t bits_from(std::uint32_t first) { return ~std::uint64_t{0} << first; }

// Bits [0, last] of a word.
std::uint64_t bits_to(std::uint32_t last) { return ~std::uint64_t{0} >> (63 - last); }

}  // namespace

BlockFlags::BlockFlags(std::uint32_t width, std::uint32_t height, std::uint32_t block) : block_(block) {
  check(block >= 1, "a block is at least one pixel wide");
  columns_ = blocks_over(width, block);
  rows_ = blocks_over(height, block);
  words_a_row_ = blocks_over(columns_, 64);
  words_.resize(std::size_t{words_a_row_} * rows_);
}

void BlockFlags::set_pixels(std::uint32_t line, std::uint32_t first, std::uint32_t count) {
  const std::uint32_t left = first / block_;
  const std::uint32_t right = (first + count - 1) / block_;
  std::uint64_t* words = &words_[std::size_t{line / block_} * words_a_row_];
  if (left / 64 == right / 64) {
    words[left / 64] |= bits_from(left % 64) & bits_to(right % 64);
    return;
  }
  words[left / 64] |= bits_from(left % 64);
  for (std::uint32_t word = left / 64 + 1; word < right / 64; ++word) words[word] = ~std::uint64_t{0};
  words[right / 64] |= bits_to(right % 64);
}

void BlockFlags::set_all() {
  if (columns_ == 0) return;
  for (std::uint32_t row = 0; row < rows_; ++row) {
    std::uint64_t* words = &words_[std::size_t{row} * words_a_row_];
    std::fill(words, words + words_a_row_, ~std::uint64_t{0});
    words[words_a_row_ - 1] = bits_to((columns_ - 1) % 64);
  }
}

void BlockFlags::clear_row(std::uint32_t row) {
  std::fill_n(&words_[std::size_t{row} * words_a_row_], words_a_row_, 0);
}

bool BlockFlags::any(std::uint32_t row) const {
  const auto first = words_.begin() + static_cast<std::ptrdiff_t>(std::size_t{row} * words_a_row_);
  return std::any_of(first, first + words_a_row_, [](std::uint64_t word) { return word != 0; });
}

bool BlockFlags::at(std::uint32_t column, std::uint32_t row) const {
  return words_[std::size_t{row} * words_a_row_ + column / 64] >> (column % 64) & 1;
}

std::uint64_t BlockFlags::count() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t word : words_) sum += static_cast<std::uint64_t>(std::popcount(word));
  return sum;
}

BlockFlags& BlockFlags::operator|=(const BlockFlags& other) {
  check(block_ == other.block_ && words_.size() == other.words_.size(), "flags of pictures of one shape");
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= other.words_[i];
  return *this;
}

void BlockFlags::add_row(const BlockFlags& other, std::uint32_t row) {
  const std::size_t first = std::size_t{row} * words_a_row_;
  for (std::size_t i = first; i < first + words_a_row_; ++i) words_[i] |= other.words_[i];
}

}  // namespace mars::compositor
