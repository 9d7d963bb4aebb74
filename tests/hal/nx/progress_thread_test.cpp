// Handlers that run while their program computes, on the threads backend.
#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/nx/progress_thread.h"
#include "hal/threads/run_threads.h"

namespace mars::nx {
namespace {

// Node 0's, whichever thread runs its handlers.
long in = 0;
long shared = 0;  // also the program's, between masktrap(1) and masktrap(0)
std::atomic<long> handled = 0;

void count(long, long, long node, long) {
  shared += in;
  hrecv(1, &in, sizeof in, count);
  csend(2, nullptr, 0, node, 0);
  crecv(3, nullptr, 0);
  ++handled;
}

void send_one() {
  const long one = 1;
  csend(1, &one, sizeof one, 0, 0);
  crecv(2, nullptr, 0);
  csend(3, nullptr, 0, 0, 0);
}

void compute_until(const std::function<bool()>& done) {
  const double end = dclock() + 20;
  while (!done() && dclock() < end) std::this_thread::yield();
  EXPECT_TRUE(done());
}

TEST(ProgressThread, HandlersRunWhileTheProgramComputes) {
  shared = handled = 0;
  const auto host = [] { crecv(9, nullptr, 0); };
  const auto node = [] {
    if (mynode() == 1) {
      for (int i = 0; i < 20; ++i) send_one();
      return;
    }
    const ProgressThread progress(messages::process());
    hrecv(1, &in, sizeof in, count);
    compute_until([] { return handled == 20; });
    masktrap(1);
    EXPECT_EQ(shared, 20);
    masktrap(0);
    csend(9, nullptr, 0, myhost(), 0);
  };
  threads::run_threads(2, host, node);
}

TEST(ProgressThread, MasksAndCallsExcludeHandlers) {
  constexpr long kEach = 200;
  shared = handled = 0;
  const auto host = [] {};
  const auto node = [] {
    if (mynode() != 0) {
      for (int i = 0; i < kEach; ++i) send_one();
      gsync();
      return;
    }
    std::optional<ProgressThread> progress(messages::process());
    hrecv(1, &in, sizeof in, count);
    for (int i = 0; i < kEach; ++i) {
      masktrap(1);
      const long before = shared;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      EXPECT_EQ(shared, before);
      ++shared;
      EXPECT_EQ(masktrap(0), 1);
      long value = i;
      csend(4, &value, sizeof value, 0, 0);
      crecv(4, &value, sizeof value);
      EXPECT_EQ(value, i);
      EXPECT_EQ(infotype(), 4);
    }
    gsync();
    compute_until([] { return handled == kEach * (numnodes() - 1); });
    progress.reset();
    EXPECT_EQ(shared, kEach * numnodes());
    gsync();  // as before, without the thread
  };
  const auto all = [node] {
    node();
    if (mynode() != 0) gsync();
  };
  threads::run_threads(4, host, all);
}

TEST(ProgressThread, AHandlerThatFailsEndsAllRanks) {
  const auto host = [] { crecv(9, nullptr, 0); };
  const auto node = [] {
    const ProgressThread progress(messages::process());
    hrecv(1, nullptr, 0, [](long, long, long, long) { csend(1, nullptr, 0, 99, 0); });
    csend(1, nullptr, 0, mynode(), 0);
    crecv(9, nullptr, 0);
  };
  try {
    threads::run_threads(2, host, node);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("there is no node 99"), std::string::npos) << failure.what();
  }
}

// Many handlers may be due at any moment, most of all while the thread starts and ends.
TEST(ProgressThread, StartsAndEndsAtAnyTime) {
  shared = handled = 0;
  const auto node = [] {
    if (mynode() != 0) {
      for (int i = 0; i < 100; ++i) send_one();
      gsync();
      return;
    }
    hrecv(1, &in, sizeof in, count);
    for (int i = 0; handled < 100 * (numnodes() - 1); ++i) {
      const ProgressThread progress(messages::process());
      if (i % 2 == 0) flick();
      std::this_thread::sleep_for(std::chrono::microseconds(300 * (i % 4)));
    }
    gsync();
    EXPECT_EQ(shared, 100 * (numnodes() - 1));
  };
  threads::run_threads(
      3, [] {}, node);
}

}  // namespace
}  // namespace mars::nx
