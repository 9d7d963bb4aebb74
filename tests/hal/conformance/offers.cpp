// Memory that one rank offers and another attaches, of nodes and host alike: each offers to the next in a ring.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/messages/offered_memory.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

using messages::AttachedMemory;
using messages::MemoryName;
using messages::OfferedMemory;

constexpr std::size_t kBytes = 100'000;
constexpr long kName = 91, kSeen = 92, kGone = 93, kSeesOffer = 94;

long ranks() { return numnodes() + 1; }
long next_rank() { return (mynode() + 1) % ranks(); }
int previous_rank() { return static_cast<int>((mynode() + ranks() - 1) % ranks()); }

// These tests run on one machine; where nodes are simulated, each has its own, which shows only with several.
bool all_are_here() {
  if (is_host()) return receive_long(kSeesOffer) != 0;
  const bool here = numnodes() > 1 && messages::neighbourhood().count == numnodes();
  if (mynode() == 0) send_long(kSeesOffer, here, myhost());
  return here;
}

void fill(std::span<std::byte> bytes, long rank) {
  const Bytes all = pattern(bytes.size(), static_cast<std::uint32_t>(rank));
  std::transform(all.begin(), all.end(), bytes.begin(), [](unsigned char byte) { return std::byte{byte}; });
}

bool is_full(std::span<const std::byte> bytes, long rank) {
  const Bytes all = pattern(bytes.size(), static_cast<std::uint32_t>(rank));
  return std::equal(all.begin(), all.end(), bytes.begin(),
                    [](unsigned char wanted, std::byte byte) { return std::byte{wanted} == byte; });
}

MemoryName exchange_names(const MemoryName& mine) {
  MemoryName theirs{};
  csend(kName, &mine, sizeof mine, next_rank(), 0);
  crecv(kName, &theirs, sizeof theirs);
  return theirs;
}

std::optional<AttachedMemory> attach(int rank, const MemoryName& name, std::size_t bytes = kBytes) {
  return AttachedMemory::attach(rank, name, bytes);
}

// Tells the rank before whether this one sees its memory; the answer is whether the next sees this one's.
bool exchange_sights(bool seen) {
  send_long(kSeen, seen, previous_rank());
  return receive_long(kSeen) != 0;
}

RULE(an_offer_is_attached, "a rank can attach memory that another rank, the host or a node, offers",
     "not across machines; it is zeroed and begins at a page") {
  const OfferedMemory mine(kBytes);
  expect(std::all_of(mine.bytes().begin(), mine.bytes().end(), [](std::byte byte) { return byte == std::byte{}; }),
         "it is zeroed");
  expect_equal(reinterpret_cast<std::uintptr_t>(mine.bytes().data()) % 4096, 0);
  fill(mine.bytes(), mynode());
  const MemoryName name = exchange_names(mine.name());
  const std::optional<AttachedMemory> theirs = attach(previous_rank(), name);
  expect(!all_are_here() || theirs, "it is seen");
  if (theirs) {
    expect_equal(theirs->bytes().size(), kBytes);
    expect(is_full(theirs->bytes(), previous_rank()), "it has what the other wrote");
    fill(theirs->bytes(), 1000 + mynode());
  }
  if (exchange_sights(theirs.has_value()))
    expect(is_full(mine.bytes(), 1000 + next_rank()), "it has what the other wrote back");
}

RULE(an_attached_block_stays, "attached memory can be used even after the rank that offered it has released it",
     "nobody can attach it by its name any more") {
  std::optional<OfferedMemory> mine(kBytes);
  fill(mine->bytes(), mynode());
  const MemoryName name = exchange_names(mine->name());
  const std::optional<AttachedMemory> theirs = attach(previous_rank(), name);
  exchange_sights(theirs.has_value());
  mine.reset();
  send_empty(kGone, next_rank());
  receive_empty(kGone);
  if (theirs) expect(is_full(theirs->bytes(), previous_rank()), "it is still there");
  const OfferedMemory another(kBytes);
  expect(!attach(previous_rank(), name), "its name is refused");
}

RULE(false_names_are_refused, "a rank can attach its own memory, too; rank, name and size are enough for that",
     "a name with any bit changed, or with another rank or size, is refused") {
  const OfferedMemory mine(kBytes);
  expect(attach(static_cast<int>(mynode()), mine.name()).has_value(), "one's own is seen");
  for (const long rank : {-1L, next_rank(), ranks(), 1'000'000L})
    expect(!attach(static_cast<int>(rank), mine.name()), "another rank is refused");
  for (const std::size_t size : {std::size_t{0}, kBytes - 1, kBytes + 1, SIZE_MAX})
    expect(!attach(static_cast<int>(mynode()), mine.name(), size), "another size is refused");
  for (std::size_t bit = 0; bit < 8 * sizeof(MemoryName); ++bit) {
    MemoryName damaged = mine.name();
    damaged.words[bit / 64] ^= std::uint64_t{1} << bit % 64;
    expect(!attach(static_cast<int>(mynode()), damaged), "another name is refused");
  }
  expect(!attach(static_cast<int>(mynode()), MemoryName{}), "no name is refused");
}

RULE(an_offer_may_be_empty, "memory of no bytes can be offered and attached", "it has no bytes") {
  const OfferedMemory mine(0);
  const std::optional<AttachedMemory> same = attach(static_cast<int>(mynode()), mine.name(), 0);
  expect(same && same->bytes().empty() && mine.bytes().empty(), "it is empty");
}

}  // namespace
}  // namespace mars::conformance
