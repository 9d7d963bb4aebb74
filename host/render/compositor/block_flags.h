// One bit a block of pixels (thesis 4.10): which blocks of a picture were overwritten. Blocks are `block`
// by `block` pixels from the top left; those at the right and lower edge may be cut. A row of blocks starts
// a word of its own, bits beyond the last block are never set.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace mars::compositor {

class BlockFlags {
 public:
  BlockFlags() = default;
  BlockFlags(std::uint32_t width, std::uint32_t height, std::uint32_t block);

  std::uint32_t block() const { return block_; }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }

  // Flags the blocks under `count` >= 1 pixels of `line` from `first`, all inside the picture.
  void set_pixels(std::uint32_t line, std::uint32_t first, std::uint32_t count);
  void set_all();
  void clear() { std::fill(words_.begin(), words_.end(), 0); }
  void clear_row(std::uint32_t row);

  bool any(std::uint32_t row) const;
  bool at(std::uint32_t column, std::uint32_t row) const;
  std::uint64_t count() const;

  // Also those of `other`, which has the same shape; of all rows, or of one.
  BlockFlags& operator|=(const BlockFlags& other);
  void add_row(const BlockFlags& other, std::uint32_t row);
  bool operator==(const BlockFlags&) const = default;

  // Calls visit(first, last) for each unbroken stretch [first, last) of flagged columns in a row of blocks.
  template <typename Visit>
  void for_stretches(std::uint32_t row, Visit visit) const {
    const std::uint64_t* words = &words_[std::size_t{row} * words_a_row_];
    std::uint32_t first = next(words, 0, 0);
    while (first < columns_) {
      const std::uint32_t last = next(words, first, ~std::uint64_t{0});
      visit(first, last);
      first = next(words, last, 0);
    }
  }

  // Calls visit(first, last, flagged) for each part of the columns [first, last) in a row that is flagged
  // throughout or not at all.
  template <typename Visit>
  void for_parts(std::uint32_t row, std::uint32_t first, std::uint32_t last, Visit visit) const {
    while (first < last) {
      const bool flagged = at(first, row);
      const std::uint64_t flip = flagged ? ~std::uint64_t{0} : 0;
      const std::uint32_t end = std::min(last, next(&words_[std::size_t{row} * words_a_row_], first, flip));
      visit(first, end, flagged);
      first = end;
    }
  }

 private:
  // The first column from `from` on whose bit differs from those of `flip`; columns_ if there is none.
  std::uint32_t next(const std::uint64_t* words, std::uint32_t from, std::uint64_t flip) const {
    while (from < columns_) {
      const std::uint64_t rest = (words[from / 64] ^ flip) >> (from % 64);
      if (rest != 0) return std::min(columns_, from + static_cast<std::uint32_t>(std::countr_zero(rest)));
      from = (from / 64 + 1) * 64;
    }
    return columns_;
  }

  std::uint32_t block_ = 1;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::uint32_t words_a_row_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace mars::compositor
