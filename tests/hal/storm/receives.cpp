#include "tests/hal/storm/receives.h"

#include <algorithm>

#include "hal/messages/message_types.h"

namespace mars::storm {
namespace {

const Kind& any_kind(Random& random, bool force) {
  for (;;) {
    const Kind& kind = kinds()[below(random, kinds().size())];
    if (kind.force() == force) return kind;
  }
}

// A set of some of the low types, or with bit 30 of the high ones too.
std::int32_t any_set(Random& random) {
  std::uint32_t set = 0;
  for (int count = 0; count < 3; ++count) set |= 1u << std::min(any_kind(random, false).type, 30);
  return static_cast<std::int32_t>(set | 1u << 31);
}

constexpr std::size_t kLong = 100'000;
constexpr std::size_t kLongs = 4;

}  // namespace

Buffers::Buffer Buffers::get(std::size_t capacity) {
  if (capacity <= kLong) return std::make_unique_for_overwrite<unsigned char[]>(capacity);
  const auto free = std::find_if(long_.begin(), long_.end(), [](const Buffer& one) { return one.use_count() == 1; });
  if (free != long_.end()) return *free;
  if (long_.size() == kLongs) return nullptr;
  return long_.emplace_back(std::make_unique_for_overwrite<unsigned char[]>(capacity_for(-1)));
}

std::size_t capacity_for(std::int32_t typesel) {
  std::size_t capacity = 0;
  for (const Kind& kind : kinds())
    if (messages::selects(typesel, kind.type)) capacity = std::max(capacity, kind.longest);
  return capacity;
}

std::int32_t any_typesel(Random& random) {
  const std::size_t choice = below(random, 20);
  if (choice < 3) return -1;
  if (choice < 6) return any_kind(random, true).type;
  if (choice < 12) return any_set(random);
  return any_kind(random, false).type;
}

std::int32_t type_for(std::int32_t typesel) {
  return std::find_if(kinds().begin(), kinds().end(),
                      [typesel](const Kind& kind) { return messages::selects(typesel, kind.type); })
      ->type;
}

}  // namespace mars::storm
