#include "tests/fuzz/edits.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace mars::fuzz {
namespace {

// Numbers at which readers go wrong.
constexpr std::array<std::uint64_t, 16> kEdges{0,          1,          2,          3,          7,          16,
                                               0xff,       0xffff,     0x10000,    0x7fffffff, 0x80000000, 0xffffffff,
                                               1ull << 32, 1ull << 40, 1ull << 63, ~0ull};
constexpr std::array<double, 8> kEdgeReals{0,      -1,
                                           1e-320, 1e300,
                                           -1e12,  std::numeric_limits<double>::infinity(),
                                           1e9,    std::numeric_limits<double>::quiet_NaN()};

template <typename Number>
void put(Message& message, std::size_t at, Number number) {
  const std::size_t aligned = at / sizeof number * sizeof number;
  if (aligned + sizeof number <= message.size()) std::memcpy(message.data() + aligned, &number, sizeof number);
}

template <typename Number>
void add(Message& message, std::size_t at, int more) {
  const std::size_t aligned = at / sizeof(Number) * sizeof(Number);
  if (aligned + sizeof(Number) > message.size()) return;
  Number number;
  std::memcpy(&number, message.data() + aligned, sizeof number);
  put(message, aligned, static_cast<Number>(number + static_cast<Number>(more)));
}

}  // namespace

std::uint8_t Script::byte() {
  if (rest_.empty()) return 0;
  const auto next = static_cast<std::uint8_t>(rest_.front());
  rest_.remove_prefix(1);
  return next;
}

std::uint32_t Script::word() {
  const std::uint32_t low = byte();
  return low | std::uint32_t{byte()} << 8;
}

std::size_t Script::below(std::size_t bound) { return (bound <= 256 ? byte() : word()) % bound; }

void edit(Message& message, Script& script, std::size_t longest) {
  const std::uint8_t what = script.byte();
  const std::size_t at = message.empty() ? 0 : script.below(message.size());
  switch (what % 9) {
    case 0: put(message, at, script.byte()); break;
    case 1: add<std::uint32_t>(message, at, static_cast<std::int8_t>(script.byte())); break;
    case 2: put(message, at, static_cast<std::uint32_t>(kEdges[script.below(kEdges.size())])); break;
    case 3: put(message, at, kEdges[script.below(kEdges.size())]); break;
    case 4: put(message, at, kEdgeReals[script.below(kEdgeReals.size())]); break;
    case 5: put(message, at, static_cast<float>(kEdgeReals[script.below(kEdgeReals.size())])); break;
    case 6: put(message, at, script.word() * 65537u); break;
    case 7: add<std::uint16_t>(message, at, static_cast<std::int8_t>(script.byte())); break;
    default: message.resize(std::min(longest, script.byte() < 128 ? at : message.size() + at));
  }
}

}  // namespace mars::fuzz
