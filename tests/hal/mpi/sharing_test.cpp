// Memory of a machine's nodes over MPI: large blocks of which little is used, and blocks that one node cannot have.
#include <sys/resource.h>

#include <cstddef>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "topology/memory_limit.h"

namespace mars::messages {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;
constexpr std::size_t kGiB = std::size_t{1} << 30;

bool is_node() { return mynode() != myhost(); }

TEST(Sharing, ABlockMayBeMuchLargerThanWhatIsUsedOfIt) {
  if (!is_node()) return;
  constexpr std::size_t kSize = 64 * kGiB;
  SharedMemory memory(kSize);
  memory.prefer_large_pages();
  const std::size_t mine = kSize / static_cast<std::size_t>(numnodes()) * static_cast<std::size_t>(mynode());
  memory.bytes()[mine] = static_cast<std::byte>(1 + mynode());
  gsync();
  for (long node = 0; node < numnodes(); ++node)
    EXPECT_EQ(memory.bytes()[kSize / static_cast<std::size_t>(numnodes()) * static_cast<std::size_t>(node)],
              static_cast<std::byte>(1 + node));
  gsync();
}

// Each lets go when it likes, without the others.
TEST(Sharing, ANodeMayKeepItsBlock) {
  if (!is_node()) return;
  std::optional<SharedMemory> memory(kMiB);
  if (mynode() == 0) memory->bytes()[5] = std::byte{5};
  gsync();
  if (mynode() == 0) memory.reset();
  gsync();
  if (memory) {
    EXPECT_EQ(memory->bytes()[5], std::byte{5});
  }
}

// The last node comes when all others have said, from within, that they wait.
TEST(Sharing, WhoWaitsForTheOthersIsCalled) {
  if (!is_node()) return;
  constexpr long kWaits = 7;
  const long last = numnodes() - 1;
  bool said = false;
  process().while_waiting([&] {
    if (!std::exchange(said, true)) csend(kWaits, nullptr, 0, last, 0);
  });
  if (mynode() == last)
    for (long i = 0; i < last; ++i) crecv(kWaits, nullptr, 0);
  const SharedMemory memory(kMiB);
  process().while_waiting({});
  EXPECT_TRUE(said || mynode() == last);
  gsync();
  while (iprobe(kWaits) == 1) crecv(kWaits, nullptr, 0);
}

TEST(Sharing, WhatOneNodeCannotHaveNoneHas) {
  if (!is_node()) return;
  const long short_one = numnodes() - 1;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit limit = before;
  limit.rlim_cur = topology::process_memory().addresses + kGiB;
  if (mynode() == short_one) {
    ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  }
  EXPECT_THROW(SharedMemory{600 * kMiB}, Failure);
  EXPECT_NO_THROW(SharedMemory{kMiB});
  if (mynode() == short_one) {
    ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  }
  EXPECT_NO_THROW(SharedMemory{600 * kMiB});
  EXPECT_THROW(SharedMemory{std::size_t{1} << 50}, Failure);
}

}  // namespace
}  // namespace mars::messages
