// What every rank of a storm sends, from a seed that all ranks know: so each knows what will come to it, from whom and
// in which order, though not when. Messages of "loose" types are long enough to carry their number, for they may be
// lost on purpose: flushed, or discarded as force messages that nobody awaits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace mars::storm {

using Random = std::mt19937_64;

// From 0 to below `end`.
std::size_t below(Random& random, std::size_t end);

struct Kind {
  std::int32_t type;
  std::size_t shortest;
  std::size_t longest;
  std::uint32_t weight;  // how often it is sent
  bool flushed;          // flushmsg may throw it away

  bool force() const { return type >= 1'073'741'824; }
  bool loose() const { return flushed || force(); }
};

std::span<const Kind> kinds();
const Kind& kind_of(std::int32_t type);

// What a rank says to all others in a round, by types that no wildcard selects: that it has sent all its messages,
// and that it has received all that was sent to it.
constexpr std::int32_t kSentAll = 1'500'000'000;
constexpr std::int32_t kGotAll = 1'500'000'001;

struct Send {
  int to;  // -1: all other nodes
  std::int32_t type;
  std::size_t length;
  std::uint32_t number;  // of this sender's in this round
};

// What `rank` sends in a round, in this order; ranks are the nodes and the host, whose id is `nodes`.
std::vector<Send> sends_of(std::uint64_t seed, int round, int rank, int nodes);

// The bytes of a message. From 8 bytes on it begins with its sender and its number.
std::vector<unsigned char> contents(std::uint64_t seed, int from, std::uint32_t number, std::size_t length);
std::uint32_t number_in(const unsigned char* bytes);

}  // namespace mars::storm
