// Strict mode: what is longer than 100 bytes has been received when its send is done.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"

namespace mars::messages {
namespace {

using std::chrono::milliseconds;

void run_strictly(int nodes, const std::function<void()>& host, const std::function<void()>& node,
                  milliseconds patience = milliseconds(60'000)) {
  const auto strictly = [patience](const std::function<void()>& body) {
    return [patience, body] {
      process().set_strict(patience);
      body();
    };
  };
  threads::run_threads(nodes, strictly(host), strictly(node));
}

void idle_host() {}

char buffer_of_all[1000];  // only ever sent

TEST(Strict, SendsWaitForReceives) {
  std::atomic<bool> sent = false, receiving = false;
  const auto send = [&] {
    csend(1, buffer_of_all, 100, 1, 0);
    EXPECT_FALSE(receiving);
    const long mid = isend(2, buffer_of_all, 101, 1, 0);
    for (int look = 0; look < 3; ++look) EXPECT_EQ(msgdone(mid), 0);
    sent = true;
    csend(3, buffer_of_all, 1000, 1, 0);
    EXPECT_TRUE(receiving);
    EXPECT_EQ(msgdone(mid), 1);  // it was received before
  };
  const auto receive = [&] {
    std::vector<char> in(1000);
    while (!sent) std::this_thread::yield();
    std::this_thread::sleep_for(milliseconds(20));
    receiving = true;
    for (const long type : {1, 2, 3}) crecv(type, in.data(), 1000);
  };
  run_strictly(2, idle_host, [&] {
    if (mynode() == 0) send();
    if (mynode() == 1) receive();
    gsync();
  });
}

TEST(Strict, NoProgramThatPostsItsReceivesFirstIsHeld) {
  run_strictly(5, idle_host, [] {
    const long next = (mynode() + 1) % numnodes();
    const std::vector<long> out(500, mynode());
    std::vector<long> in(500), all(500);
    const long bytes = 4000;
    for (int round = 0; round < 20; ++round) {
      const long mid = irecv(1, in.data(), bytes);
      csend(1, out.data(), bytes, next, 0);
      msgwait(mid);
      EXPECT_EQ(csendrecv(2, out.data(), bytes, next, 0, 2, in.data(), bytes), bytes);
      msgwait(isendrecv(3, out.data(), bytes, next, 0, 3, in.data(), bytes));
      const long from_zero = mynode() == 0 ? -1 : irecv(4, all.data(), bytes);
      gsync();
      if (mynode() == 0) csend(4, out.data(), bytes, -1, 0);
      if (mynode() != 0) msgwait(from_zero);
      EXPECT_EQ(all[499], 0);
      const long given_up = isend(5, out.data(), bytes, next, 0);
      msgcancel(given_up);
      flushmsg(5, -1, -1);
      gdsum(reinterpret_cast<double*>(in.data()), 500, reinterpret_cast<double*>(all.data()));
      std::fill(all.begin(), all.end(), 0);
    }
    gsync();
    flushmsg(5, -1, -1);
  });
}

// flushmsg lets the sender of a message go; a cancelled receive has had it.
TEST(Strict, MessagesThatAreThrownAwayHoldNobody) {
  run_strictly(2, idle_host, [] {
    std::vector<char> in(1000);
    if (mynode() == 0) {
      csend(1, buffer_of_all, 1000, 1, 0);
      csend(2, buffer_of_all, 1000, 1, 0);
    } else {
      cprobe(1);
      flushmsg(1, 0, 0);
      const long mid = irecv(2, in.data(), 1000);
      cprobe(3);
      msgcancel(mid);
      crecv(2, in.data(), 1000);
      crecv(3, in.data(), 1000);
    }
    if (mynode() == 0) csend(3, buffer_of_all, 10, 1, 0);
    gsync();
  });
}

// The end of the world comes from elsewhere.
TEST(Strict, WaitsAreReportedWhenTheWorldEnds) {
  testing::internal::CaptureStderr();
  const auto end_it = [] {
    std::this_thread::sleep_for(milliseconds(300));
    throw Failure("nothing moves", "", "");
  };
  EXPECT_THROW(run_strictly(1, end_it, [] { csend(7, buffer_of_all, 200, 0, 0); }), Failure);
  const std::string printed = testing::internal::GetCapturedStderr();
  EXPECT_NE(printed.find("in csend until node 0 receives 200 bytes"), std::string::npos) << printed;
}

TEST(Strict, LongWaitsAreReported) {
  testing::internal::CaptureStderr();
  const auto end_it = [] {
    std::this_thread::sleep_for(milliseconds(1000));
    throw Failure("seen enough", "", "");
  };
  const auto head_to_head = [] {
    if (mynode() == 2) {
      crecv(77, nullptr, 0);
    } else {
      csend(7, buffer_of_all, 200, 1 - mynode(), 0);
      crecv(7, nullptr, 0);
    }
  };
  EXPECT_THROW(run_strictly(3, end_it, head_to_head, milliseconds(100)), Failure);
  const std::string printed = testing::internal::GetCapturedStderr();
  for (const std::string line :
       {"s in csend until node 1 receives 200 bytes, type 7", "s in csend until node 0 receives 200 bytes, type 7",
        "s in crecv for a message, typesel 77", "node 0 has waited", "node 1 has waited", "strict mode"}) {
    EXPECT_NE(printed.find(line), std::string::npos) << printed;
  }
  EXPECT_EQ(printed.find("node 0 has"), printed.rfind("node 0 has")) << "printed once:\n" << printed;
}

}  // namespace
}  // namespace mars::messages
