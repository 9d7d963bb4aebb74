#include "host/images/huffman_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mars::images {
namespace {

using Counts = std::vector<std::uint32_t>;

std::uint64_t bits_of(const Counts& counts, const HuffmanCode& code) {
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) bits += std::uint64_t{counts[k]} * code.lengths[k];
  return bits;
}

// The plain twin: joins the two rarest until one tree is left; each join costs a bit of all below it.
std::uint64_t bits_of_tree(const Counts& counts) {
  std::vector<std::uint64_t> weights;
  for (const std::uint32_t count : counts)
    if (count > 0) weights.push_back(count);
  std::uint64_t bits = 0;
  while (weights.size() > 1) {
    std::ranges::sort(weights, std::greater());
    const std::uint64_t joined = weights.back() + weights[weights.size() - 2];
    weights.resize(weights.size() - 2);
    weights.push_back(joined);
    bits += joined;
  }
  return bits;
}

// No word begins with another, and none is missing.
void expect_prefix_code(const HuffmanCode& code, std::uint32_t longest) {
  std::vector<bool> taken(std::size_t{1} << longest);
  for (std::size_t k = 0; k < code.words.size(); ++k) {
    const std::uint32_t length = code.lengths[k];
    if (length == 0) continue;
    ASSERT_LE(length, longest);
    for (std::size_t rest = 0; rest < std::size_t{1} << (longest - length); ++rest) {
      const std::size_t at = code.words[k] | rest << length;
      ASSERT_FALSE(taken[at]);
      taken[at] = true;
    }
  }
  EXPECT_EQ(std::ranges::count(taken, false), 0);
}

TEST(HuffmanCode, IsTheShortest) {
  std::mt19937 random(5);
  for (int k = 0; k < 200; ++k) {
    Counts counts(2 + random() % 285);
    for (std::uint32_t& count : counts) count = random() % 3 == 0 ? 0 : random() % 1000;
    counts.front() = counts.back() = 7;
    const HuffmanCode code = huffman_code(counts, 15);
    EXPECT_EQ(bits_of(counts, code), bits_of_tree(counts));
    expect_prefix_code(code, 15);
  }
}

// Fibonacci's numbers make the deepest trees.
TEST(HuffmanCode, KeepsTheLongestLength) {
  Counts counts{1, 1};
  while (counts.size() < 40) counts.push_back(counts.back() + counts[counts.size() - 2]);
  for (const std::uint32_t longest : {6u, 7u, 15u}) expect_prefix_code(huffman_code(counts, longest), longest);
}

TEST(HuffmanCode, OneSymbolHasABit) {
  const HuffmanCode code = huffman_code(Counts{0, 5, 0}, 15);
  EXPECT_EQ(code.lengths, (std::vector<std::uint8_t>{0, 1, 0}));
}

}  // namespace
}  // namespace mars::images
