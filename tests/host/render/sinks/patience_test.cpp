#include "host/render/sinks/patience.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <thread>
#include <vector>

#include "tests/host/content/document/failure_of.h"

namespace mars::sinks {
namespace {

using namespace std::chrono_literals;
using document::FileFailure;
using document::holds;

[[noreturn]] void fail(int error) { throw FileFailure("cannot write: no", "a/.runs/b", "make room", error); }

class PatienceOf : public testing::Test {
 protected:
  Patience::Bounds bounds(Patience::Duration longest, Patience::Duration silence = 1h) {
    return {.warn =
                [this](const std::string& line) {
                  said_.push_back(line);
                  ++lines_;
                },
            .longest = longest,
            .pause = 2ms,
            .silence = silence};
  }

  void wait_for_lines(int lines) const {
    while (lines_ < lines) std::this_thread::sleep_for(1ms);
  }

  std::vector<std::string> said_;  // to be read when nothing waits any more
  std::atomic<int> lines_ = 0;
};

TEST_F(PatienceOf, WhatPassesIsWaitedForAndSaidOnce) {
  for (const int error : {ENOSPC, EDQUOT, EIO, ESTALE, ETIMEDOUT, EROFS, EACCES}) {
    said_.clear();
    Patience patience(bounds(1min));
    int tries = 0;
    patience.write("f", [&] {
      if (++tries < 5) fail(error);
    });
    EXPECT_EQ(tries, 5);
    ASSERT_EQ(said_.size(), 2u);
    EXPECT_EQ(said_[0],
              "a/.runs/b: cannot write: no; waiting up to 1 minute: the run goes on by itself, and the same command "
              "goes on later");
    EXPECT_EQ(said_[1], "f is written: the run goes on");
  }
}

TEST_F(PatienceOf, OtherFailuresAreNotWaitedFor) {
  Patience patience(bounds(1h));
  for (const int error : {ENOENT, EFBIG, ENOTDIR, EISDIR, EMFILE}) {
    int tries = 0;
    const auto write = [&] { ++tries, fail(error); };
    EXPECT_EQ(document::failure_of([&] { patience.write("f", write); }),
              "a/.runs/b: cannot write: no (make room; the same command then goes on where this run stopped)");
    EXPECT_EQ(tries, 1);
  }
  EXPECT_EQ(document::failure_of([&] { patience.write("f", [] { throw Failure("another", "", ""); }); }), "another");
  EXPECT_TRUE(said_.empty());
}

TEST_F(PatienceOf, BeforeTheBeginningPermissionsAreNotWaitedFor) {
  Patience patience(bounds(1min));
  for (const int error : {EROFS, EACCES})
    EXPECT_EQ(document::failure_of([&] { patience.begin("f", [&] { fail(error); }); }),
              "a/.runs/b: cannot write: no (make room)");
  int tries = 0;
  patience.begin("f", [&] {
    if (++tries < 3) fail(ENOSPC);
  });
  EXPECT_EQ(tries, 3);
}

TEST_F(PatienceOf, ItEnds) {
  Patience patience(bounds(20ms));
  int tries = 0;
  const std::string failure = document::failure_of([&] { patience.write("f", [&] { ++tries, fail(ENOSPC); }); });
  EXPECT_TRUE(holds(failure, "cannot write: no, after waiting for 1 second (make room; the same command")) << failure;
  EXPECT_GE(tries, 2);
  EXPECT_LE(tries, 11) << "a pause between any two";
  EXPECT_EQ(said_.size(), 1u);
}

TEST_F(PatienceOf, OfManyThatWaitOneIsNamed) {
  Patience patience(bounds(1min));
  std::atomic<bool> room = false;
  std::atomic<int> waiting = 0;
  std::vector<std::jthread> threads;
  for (int i = 0; i < 6; ++i)
    threads.emplace_back([&] {
      bool waited = false;
      patience.write("f", [&] {
        if (!std::exchange(waited, true)) ++waiting;
        if (!room) fail(ENOSPC);
      });
    });
  while (waiting < 6) std::this_thread::yield();
  room = true;
  threads.clear();
  EXPECT_EQ(said_.size(), 2u);
}

TEST_F(PatienceOf, WhoGivesUpWaitsNoLonger) {
  Patience patience(bounds(1h));
  std::atomic<int> tries = 0;
  std::string failure;
  std::jthread waits(
      [&] { failure = document::failure_of([&] { patience.write("f", [&] { ++tries, fail(ENOSPC); }); }); });
  while (tries == 0) std::this_thread::yield();
  patience.give_up();
  waits.join();
  EXPECT_TRUE(holds(failure, "cannot write: no"));
  EXPECT_NE(document::failure_of([&] { patience.write("f", [] { fail(ENOSPC); }); }), "");
}

TEST_F(PatienceOf, StorageWithoutAnAnswerIsSaidAndGoesOn) {
  Patience patience(bounds(1h, 10ms));
  std::atomic<bool> hangs = true;
  std::jthread writes([&] {
    patience.write("f", [&] {
      while (hangs) std::this_thread::sleep_for(1ms);
    });
  });
  wait_for_lines(1);
  patience.check();
  hangs = false;
  writes.join();
  wait_for_lines(2);
  ASSERT_EQ(said_.size(), 2u);
  EXPECT_EQ(said_[0], "f: storage has given no answer for 1 second, or is slow; the run goes on by itself");
  EXPECT_EQ(said_[1], "storage answers again: the run goes on");
}

TEST_F(PatienceOf, WithoutAnAnswerForLongItIsAFailure) {
  Patience patience(bounds(20ms, 10ms));
  std::atomic<bool> hangs = true;
  std::jthread writes([&] {
    patience.write("f", [&] {
      while (hangs) std::this_thread::sleep_for(1ms);
    });
  });
  std::string failure;
  while (failure.empty()) failure = document::failure_of([&] { patience.check(); });
  EXPECT_TRUE(holds(failure, "f: storage has given no answer for 1 second (see whether")) << failure;
  hangs = false;
}

TEST_F(PatienceOf, OfFailuresThatTakeLongOnlyTheFirstIsSaid) {
  Patience patience(bounds(1h, 10ms));
  int tries = 0;
  patience.write("f", [&] {
    if (++tries > 1) std::this_thread::sleep_for(30ms);
    if (tries < 4) fail(EIO);
  });
  patience.give_up();
  EXPECT_EQ(said_.size(), 2u);
}

TEST_F(PatienceOf, WhoWaitsForOtherRunsIsNotCalledSilent) {
  Patience patience(bounds(1h, 1s));
  patience.begin("f", [&] {
    for (int i = 0; i < 12; ++i) {
      std::this_thread::sleep_for(100ms);
      patience.note_answer();
    }
  });
  EXPECT_TRUE(said_.empty());
}

}  // namespace
}  // namespace mars::sinks
