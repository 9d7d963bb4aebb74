// Steady traffic allocates nothing, on any rank: after a warm-up, operator new is counted.
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "hal/collectives/group_sum.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"
#include "tests/counted_new.h"

namespace {

std::atomic<long> allocations = 0;

}  // namespace

void* mars::test::allocate(std::size_t size, std::size_t alignment) noexcept {
  ++allocations;
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
void mars::test::release(void* block) noexcept { std::free(block); }

namespace mars::messages {
namespace {

struct Buffers {
  std::vector<char> out = std::vector<char>(200'000, 'x');
  std::vector<char> in = std::vector<char>(200'000);
  std::vector<std::uint64_t> values = std::vector<std::uint64_t>(1000);
  std::vector<std::uint64_t> work = std::vector<std::uint64_t>(1000);
};

// Messages of many lengths, expected and not, to nodes and the host, and collectives.
void exchange(Buffers& buffers) {
  const long next = (mynode() + 1) % numnodes();
  for (const long length : {0L, 8L, 100L, 5000L, 200'000L}) {
    csend(1, buffers.out.data(), length, next, 0);
    csend(2, buffers.out.data(), length, next, 0);
    const long mid = isend(3, buffers.out.data(), length, next, 0);
    crecv(3, buffers.in.data(), length);
    crecv(2, buffers.in.data(), length);
    cprobe(1);
    crecv(1, buffers.in.data(), infocount());
    msgwait(mid);
    csend(4, buffers.out.data(), length, myhost(), 0);
  }
  collectives::group_sum({0, static_cast<int>(numnodes())}, buffers.values, buffers.work);
  long count = 0;
  gcol(buffers.out.data(), 1000, buffers.in.data(), 200'000, &count);
  gsync();
}

void collect(Buffers& buffers) {
  for (long i = 0; i < 5 * numnodes(); ++i) crecv(4, buffers.in.data(), 200'000);
  csend(5, nullptr, 0, -1, 0);
}

TEST(Allocation, NoneInSteadyState) {
  constexpr int kWarmUp = 50;
  constexpr int kRounds = 200;
  long before = 0;
  long after = 0;
  const auto host = [&] {
    Buffers buffers;
    for (int round = 0; round < kWarmUp + kRounds; ++round) {
      if (round == kWarmUp) before = allocations;
      collect(buffers);
    }
    after = allocations;
    csend(6, nullptr, 0, -1, 0);
  };
  const auto node = [] {
    Buffers buffers;
    for (int round = 0; round < kWarmUp + kRounds; ++round) {
      exchange(buffers);
      crecv(5, nullptr, 0);
    }
    crecv(6, nullptr, 0);
  };
  threads::run_threads(5, host, node);
  EXPECT_EQ(after - before, 0);
}

}  // namespace
}  // namespace mars::messages
