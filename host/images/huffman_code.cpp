#include "host/images/huffman_code.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace mars::images {
namespace {

constexpr std::size_t kMostBits = 15;  // bits, in DEFLATE
constexpr std::size_t kDeepest = 64;   // more than a tree over 32-bit counts can be deep

using WordsOfLength = std::array<std::uint32_t, kDeepest>;

struct Symbol {
  std::uint64_t count;
  std::uint32_t number;
};

// Those that occur, the rarest first.
std::vector<Symbol> occurring(std::span<const std::uint32_t> counts) {
  std::vector<Symbol> symbols;
  for (std::uint32_t number = 0; number < counts.size(); ++number)
    if (counts[number] > 0) symbols.push_back({counts[number], number});
  std::ranges::sort(symbols, [](const Symbol& a, const Symbol& b) {
    return a.count != b.count ? a.count < b.count : a.number < b.number;
  });
  return symbols;
}

// How many words of each length Huffman's tree over at least two symbols has. Two queues suffice (van Leeuwen 1976):
// the symbols, and the trees already joined, for these are joined in ascending order.
WordsOfLength words_of_tree(const std::vector<Symbol>& symbols) {
  const std::size_t leaves = symbols.size(), joins = leaves - 1;
  std::vector<std::uint64_t> weight(joins);
  std::vector<std::size_t> parent(leaves + joins);  // of the leaves, then of the joins
  std::size_t leaf = 0, join = 0;
  for (std::size_t made = 0; made < joins; ++made) {
    for (int child = 0; child < 2; ++child) {
      const bool takes_leaf = leaf < leaves && (join == made || symbols[leaf].count <= weight[join]);
      weight[made] += takes_leaf ? symbols[leaf].count : weight[join];
      parent[takes_leaf ? leaf++ : leaves + join++] = made;
    }
  }
  WordsOfLength words{};
  std::vector<std::size_t> depth(joins);
  for (std::size_t made = joins - 1; made-- > 0;) depth[made] = depth[parent[leaves + made]] + 1;
  for (std::size_t at = 0; at < leaves; ++at) ++words[std::min(depth[parent[at]] + 1, kDeepest - 1)];
  return words;
}

// Words that are too long become as long as allowed; then shorter ones are made longer until a prefix code remains.
void limit_lengths(WordsOfLength& words, std::uint32_t longest) {
  for (std::size_t length = longest + 1; length < kDeepest; ++length) words[longest] += std::exchange(words[length], 0);
  const std::uint64_t room = std::uint64_t{1} << longest;
  std::uint64_t taken = 0;
  for (std::uint32_t length = 1; length <= longest; ++length)
    taken += std::uint64_t{words[length]} << (longest - length);
  for (; taken > room; --taken) {
    std::uint32_t shorter = longest - 1;
    while (words[shorter] == 0) --shorter;
    --words[longest];
    --words[shorter];
    words[shorter + 1] += 2;
  }
}

std::uint32_t reversed(std::uint32_t word, std::uint32_t length) {
  std::uint32_t turned = 0;
  for (; length > 0; --length, word >>= 1) turned = turned << 1 | (word & 1);
  return turned;
}

void number_words(HuffmanCode& code) {
  std::array<std::uint32_t, kMostBits + 2> next{};
  for (const std::uint8_t length : code.lengths)
    if (length > 0) ++next[length + 1u];
  for (std::size_t length = 2; length < next.size(); ++length) next[length] = (next[length] + next[length - 1]) << 1;
  for (std::size_t symbol = 0; symbol < code.lengths.size(); ++symbol)
    if (const std::uint32_t length = code.lengths[symbol]; length > 0)
      code.words[symbol] = reversed(next[length]++, length);
}

}  // namespace

HuffmanCode huffman_code(std::span<const std::uint32_t> counts, std::uint32_t longest) {
  HuffmanCode code{std::vector<std::uint32_t>(counts.size()), std::vector<std::uint8_t>(counts.size())};
  const std::vector<Symbol> symbols = occurring(counts);
  WordsOfLength words{};
  words[1] = static_cast<std::uint32_t>(symbols.size());
  if (symbols.size() > 1) words = words_of_tree(symbols);
  limit_lengths(words, longest);
  auto symbol = symbols.begin();
  for (std::uint32_t length = longest; length > 0; --length)
    for (std::uint32_t k = 0; k < words[length]; ++k)
      code.lengths[symbol++->number] = static_cast<std::uint8_t>(length);
  number_words(code);
  return code;
}

}  // namespace mars::images
