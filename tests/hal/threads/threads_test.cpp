// How a run of threads ends, what goes between a rank and its backend, and calls on foreign threads.
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "hal/messages/message_types.h"
#include "hal/messages/process.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"
#include "tests/hal/counting_backend.h"

namespace mars::threads {
namespace {

void wait_for_ever() { crecv(1, nullptr, 0); }

std::string failure_of(const std::function<void()>& host, const std::function<void()>& node) {
  const double start = dclock();
  std::string reason = "none";
  try {
    run_threads(5, host, node);
  } catch (const std::exception& failure) {
    reason = failure.what();
  }
  EXPECT_LT(dclock() - start, 5);
  return reason;
}

TEST(Threads, AThrowingNodeEndsAll) {
  const auto node = [] {
    if (mynode() == 3) throw std::runtime_error("node 3's own");
    wait_for_ever();
  };
  EXPECT_EQ(failure_of(wait_for_ever, node), "node 3's own");
}

TEST(Threads, TheHostLearnsWhyANodeEnded) {
  std::string learnt = "nothing";
  const auto host = [&] {
    try {
      wait_for_ever();
    } catch (const std::exception& failure) {
      learnt = failure.what();
      throw;
    }
  };
  failure_of(host, [] { throw std::runtime_error("the node's own"); });
  EXPECT_EQ(learnt, "the node's own");
}

TEST(Threads, AThrowingHostEndsAll) {
  EXPECT_EQ(failure_of([] { throw std::runtime_error("the host's own"); }, wait_for_ever), "the host's own");
}

TEST(Threads, RanksAtTheirEndAreEndedToo) {
  const auto node = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (mynode() == 0) throw std::runtime_error("late");
  };
  EXPECT_EQ(failure_of([] {}, node), "late");
}

TEST(Threads, RanksInACollectiveAreEnded) {
  const auto node = [] {
    if (mynode() == 4) throw std::runtime_error("missing");
    for (;;) gsync();
  };
  EXPECT_EQ(failure_of(wait_for_ever, node), "missing");
}

TEST(Threads, AMessageOnItsWayFromARankThatEnds) {
  const auto node = [] {
    if (mynode() != 0) wait_for_ever();
    std::vector<char> data(1 << 22);
    isend(1, data.data(), static_cast<long>(data.size()), 1, 0);
    throw std::runtime_error("sender");
  };
  for (int again = 0; again < 20; ++again) {
    const std::string reason = failure_of(wait_for_ever, node);
    EXPECT_TRUE(reason == "sender" || reason.find("does not fit") != std::string::npos) << reason;
  }
}

TEST(Threads, AbortThrowsItsReason) {
  const auto node = [] {
    if (mynode() == 2) messages::process().backend().abort("enough");
    wait_for_ever();
  };
  EXPECT_EQ(failure_of(wait_for_ever, node), "enough");
}

TEST(Threads, MessagesThatNobodyReceivesDoNotHinderTheEnd) {
  const auto all = [] { csend(1, "12345678", 8, -1, 0); };
  run_threads(4, all, all);
}

TEST(Threads, CallsNeedARank) {
  EXPECT_THROW(mynode(), Failure);
  bool failed = false;
  const auto node = [&] {
    std::jthread([&] {
      try {
        gsync();
      } catch (const Failure&) {
        failed = true;
      }
    }).join();
  };
  run_threads(
      1, [] {}, node);
  EXPECT_TRUE(failed);
}

TEST(Threads, SharedMemoryOfDifferentSizesIsFoundOut) {
  const auto node = [] {
    const messages::SharedMemory memory(100 + static_cast<std::size_t>(mynode()));
    gsync();
  };
  EXPECT_THROW(run_threads(
                   2, [] {}, node),
               std::logic_error);
}

TEST(Threads, ABlockMayBeMuchLargerThanWhatIsUsedOfIt) {
  constexpr std::size_t kSize = std::size_t{1} << 36;
  const auto node = [] {
    messages::SharedMemory memory(kSize);
    memory.prefer_large_pages();
    if (mynode() == 0) memory.bytes()[kSize - 1] = std::byte{7};
    gsync();
    EXPECT_EQ(memory.bytes()[kSize - 1], std::byte{7});
    gsync();
  };
  run_threads(
      2, [] {}, node);
}

TEST(Threads, WhatTheMachineDoesNotGiveNoNodeGets) {
  std::atomic<int> refused = 0;
  const auto node = [&] {
    try {
      const messages::SharedMemory memory(std::size_t{1} << 50);
    } catch (const Failure&) {
      ++refused;
    }
    EXPECT_NO_THROW(messages::SharedMemory(1000));
  };
  run_threads(
      3, [] {}, node);
  EXPECT_EQ(refused, 3);
}

TEST(Counting, IsBySenderReceiverAndType) {
  messages::Counts counts;
  const auto host = [] {
    char bytes[20];
    for (int i = 0; i < 3; ++i) crecv(-1, bytes, 20);
  };
  const auto node = [] {
    csend(10 + mynode(), "0123456789", 2 + mynode(), myhost(), 0);
    gsync();
  };
  run_threads(3, host, node, messages::counting(counts));
  EXPECT_EQ(counts.sent({.to = 3}).messages, 3u);
  EXPECT_EQ(counts.sent({.to = 3}).bytes, 2u + 3u + 4u);
  EXPECT_EQ(counts.sent({.from = 1, .to = 3, .type = 11}).bytes, 3u);
  EXPECT_EQ(counts.sent({.from = 1, .type = 10}).messages, 0u);
  EXPECT_EQ(counts.sent({.from = 0, .type = messages::kFirstInternalType}).messages, 2u);  // of gsync
  counts.clear();
  EXPECT_EQ(counts.sent({}).messages, 0u);
}

}  // namespace
}  // namespace mars::threads
