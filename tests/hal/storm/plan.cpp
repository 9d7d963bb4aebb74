#include "tests/hal/storm/plan.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <string>

namespace mars::storm {
namespace {

constexpr std::size_t kSends = 60;
constexpr std::size_t kHeader = 8;

// clang-format off
constexpr std::array kKinds = {
    Kind{0, 0, 300, 20, false},        Kind{1, kHeader, 300, 10, true},
    Kind{2, 0, 300, 20, false},        Kind{4, 0, 5000, 15, false},
    Kind{5, kHeader, 5000, 8, true},   Kind{29, 0, 300, 10, false},
    Kind{30, 0, 70'000, 8, false},     Kind{31, kHeader, 70'000, 5, true},
    Kind{1000, 0, 300, 10, false},     Kind{999'999'999, 0, 8'000'000, 1, false},
    Kind{1'073'741'824, kHeader, 300, 6, false}, Kind{1'999'999'999, kHeader, 5000, 4, false}};
// clang-format on

// Where backends change their ways; one more and one less are as interesting.
constexpr std::array<std::size_t, 6> kThresholds = {0, 100, 256, 4096, 65'536, 1'048'576};

const Kind& any_kind(Random& random) {
  const auto add = [](std::uint32_t sum, const Kind& kind) { return sum + kind.weight; };
  std::size_t left = below(random, std::accumulate(kKinds.begin(), kKinds.end(), 0u, add));
  for (const Kind& kind : kKinds) {
    if (left < kind.weight) return kind;
    left -= kind.weight;
  }
  throw std::logic_error("weights");
}

// Small ones more often.
std::size_t any_length(Random& random, const Kind& kind) {
  std::size_t length = below(random, std::size_t{1} << below(random, 24));
  if (below(random, 3) == 0) length = kThresholds[below(random, kThresholds.size())] + below(random, 3) - 1;
  return length == SIZE_MAX ? kind.shortest : std::clamp(length, kind.shortest, kind.longest);
}

}  // namespace

std::size_t below(Random& random, std::size_t end) { return random() % end; }

std::span<const Kind> kinds() { return kKinds; }

const Kind& kind_of(std::int32_t type) {
  const auto at = std::find_if(kKinds.begin(), kKinds.end(), [type](const Kind& kind) { return kind.type == type; });
  if (at == kKinds.end()) throw std::runtime_error("no message of type " + std::to_string(type) + " was sent");
  return *at;
}

std::vector<Send> sends_of(std::uint64_t seed, int round, int rank, int nodes) {
  Random random(seed * 1'000'003 + static_cast<std::uint64_t>(round) * 1009 + static_cast<std::uint64_t>(rank));
  std::vector<Send> sends;
  for (std::uint32_t number = 0; number < kSends; ++number) {
    const Kind& kind = any_kind(random);
    const std::size_t length = any_length(random, kind);
    // To all only what is short: memory is that of one machine.
    const bool to_all = length <= 5000 && below(random, 16) == 0;
    const int to = to_all ? -1 : static_cast<int>(below(random, static_cast<std::size_t>(nodes) + 1));
    sends.push_back({to, kind.type, length, number});
  }
  return sends;
}

std::vector<unsigned char> contents(std::uint64_t seed, int from, std::uint32_t number, std::size_t length) {
  std::vector<unsigned char> bytes(length);
  std::uint64_t word = (seed << 40) ^ (static_cast<std::uint64_t>(from) << 32) ^ number;
  for (std::size_t at = 0; at < length; at += sizeof word) {
    word = word * 6364136223846793005u + 1442695040888963407u;
    const std::uint64_t mixed = word ^ word >> 29;
    std::memcpy(bytes.data() + at, &mixed, std::min(sizeof mixed, length - at));
  }
  if (length < kHeader) return bytes;
  std::memcpy(bytes.data(), &from, sizeof from);
  std::memcpy(bytes.data() + sizeof from, &number, sizeof number);
  return bytes;
}

std::uint32_t number_in(const unsigned char* bytes) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes + sizeof(int), sizeof number);
  return number;
}

}  // namespace mars::storm
