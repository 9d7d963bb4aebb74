#include "host/render/sinks/sink_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <set>

#include "hal/failure/failure.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::sinks {
namespace {

using namespace std::chrono_literals;

// Keeps the numbers of its frames; may be held up, and may fail at a frame.
class TestSink : public Sink {
 public:
  void take(compositor::Frame& frame) override {
    most_at_once_ = std::max(most_at_once_.load(), ++at_once_);
    while (held) std::this_thread::sleep_for(1ms);
    const bool whole = std::count(frame.pixels.begin(), frame.pixels.end(), frame.number) ==
                       static_cast<std::ptrdiff_t>(frame.pixels.size());
    --at_once_;
    if (frame.number == fails_at) throw Failure("no room", "frame " + std::to_string(frame.number), "");
    if (!whole) throw Failure("a frame changed while the sink had it", "", "");
  }

  int most_at_once() const { return most_at_once_; }

  std::atomic<bool> held = false;
  std::uint32_t fails_at = ~0u;

 private:
  std::atomic<int> at_once_ = 0;
  std::atomic<int> most_at_once_ = 0;
};

void compose(compositor::Frame& frame, std::uint32_t number) {
  frame.number = number;
  std::fill(frame.pixels.begin(), frame.pixels.end(), number);
}

compositor::Frame& wait_for_frame(SinkPool& pool) {
  compositor::Frame* frame = nullptr;
  while ((frame = pool.free_frame()) == nullptr) std::this_thread::yield();
  return *frame;
}

TEST(SinkPool, TakesEveryFrameOnce) {
  TestSink sink;
  SinkPool pool(sink, {8, 8, 4, 3, 2});
  std::vector<std::uint32_t> taken;
  const auto note = [&] {
    for (const SinkPool::Taken& frame : pool.taken()) {
      EXPECT_LE(frame.submitted, frame.begun);
      EXPECT_LE(frame.begun, frame.ended);
      EXPECT_LT(frame.thread, 2u);
      taken.push_back(frame.number);
    }
  };
  for (std::uint32_t number = 0; number < 500; ++number) {
    compositor::Frame& frame = wait_for_frame(pool);
    compose(frame, number);
    pool.submit(&frame);
    note();
  }
  pool.finish();
  note();
  std::vector<std::uint32_t> expected(500);
  std::iota(expected.begin(), expected.end(), 0u);
  std::sort(taken.begin(), taken.end());
  EXPECT_EQ(taken, expected);
  EXPECT_LE(sink.most_at_once(), 2);
}

TEST(SinkPool, HasNoMoreFramesThanItWasGiven) {
  TestSink sink;
  sink.held = true;
  SinkPool pool(sink, {8, 8, 4, 3, 2});
  std::set<compositor::Frame*> frames;
  while (compositor::Frame* frame = pool.free_frame()) {
    compose(*frame, 0);
    frames.insert(frame);
    pool.submit(frame);
  }
  EXPECT_EQ(frames.size(), 3u);
  EXPECT_TRUE(pool.taken().empty());
  sink.held = false;
  pool.finish();
  EXPECT_EQ(pool.taken().size(), 3u);
  EXPECT_NE(pool.free_frame(), nullptr);
}

TEST(SinkPool, PrefersAFrameThatShowsTheBackground) {
  TestSink sink;
  SinkPool pool(sink, {8, 8, 4, 3, 1});
  std::vector<compositor::Frame*> frames{pool.free_frame(), pool.free_frame(), pool.free_frame()};
  for (std::uint32_t i = 0; i < 3; ++i) {
    compose(*frames[i], i);
    frames[i]->background = 10 + i;
    pool.submit(frames[i]);
  }
  pool.finish();
  EXPECT_EQ(pool.free_frame(11), frames[1]);
  EXPECT_EQ(pool.free_frame(10), frames[0]);
  EXPECT_EQ(pool.free_frame(99), frames[2]);
}

TEST(SinkPool, EarlyFramesLeaveHalfToTheOthers) {
  TestSink sink;
  for (const auto& [frames, early] : {std::pair{1u, 0u}, {2u, 1u}, {3u, 2u}, {4u, 2u}, {7u, 4u}}) {
    SinkPool pool(sink, {8, 8, 4, frames, 1});
    std::uint32_t given = 0;
    while (pool.early_frame() != nullptr) ++given;
    EXPECT_EQ(given, early) << "of " << frames;
    while (pool.free_frame() != nullptr) ++given;
    EXPECT_EQ(given, frames);
  }
}

TEST(SinkPool, NewFramesShowTheBackground) {
  TestSink sink;
  SinkPool pool(sink, {8, 8, 4, 4, 1, 77});
  while (const compositor::Frame* frame = pool.free_frame()) {
    EXPECT_EQ(frame->plain, 77u);
    EXPECT_EQ(frame->pixels, std::vector<std::uint32_t>(64, 77));
  }
}

TEST(SinkPool, AFailureReachesTheLoop) {
  TestSink sink;
  sink.fails_at = 1;
  SinkPool pool(sink, {8, 8, 4, 2, 2});
  const std::string failure = document::failure_of([&] {
    for (std::uint32_t number = 0; number < 1000; ++number) {
      compositor::Frame& frame = wait_for_frame(pool);
      compose(frame, number);
      pool.submit(&frame);
    }
  });
  EXPECT_EQ(failure, "frame 1: no room");
  EXPECT_EQ(document::failure_of([&] { pool.finish(); }), failure);
  EXPECT_EQ(document::failure_of([&] { pool.taken(); }), failure);
}

// Waits within take() until give_up() is called, and says on demand that this takes too long.
class WaitingSink : public Sink {
 public:
  void take(compositor::Frame&) override {
    while (!given_up_) std::this_thread::sleep_for(1ms);
    throw Failure("no room", "", "");
  }
  void check() override {
    if (overdue) throw Failure("no answer", "", "");
  }
  void give_up() override { given_up_ = true; }

  std::atomic<bool> overdue = false;

 private:
  std::atomic<bool> given_up_ = false;
};

TEST(SinkPool, WhatTakesTooLongIsAFailureAndItsEndIsNotWaitedFor) {
  WaitingSink sink;
  SinkPool pool(sink, {8, 8, 4, 2, 1});
  compositor::Frame* frame = pool.free_frame();
  compose(*frame, 0);
  pool.submit(frame);
  EXPECT_TRUE(pool.taken().empty());
  std::jthread later([&] {
    std::this_thread::sleep_for(20ms);
    sink.overdue = true;
  });
  EXPECT_EQ(document::failure_of([&] { pool.finish(); }), "no answer");
  EXPECT_EQ(document::failure_of([&] { pool.taken(); }), "no answer");
}

TEST(SinkPool, EndsWithFramesStillWaiting) {
  TestSink sink;
  sink.held = true;
  std::jthread later;
  {
    SinkPool pool(sink, {8, 8, 4, 4, 1});
    while (compositor::Frame* frame = pool.free_frame()) {
      compose(*frame, 0);
      pool.submit(frame);
    }
    later = std::jthread([&] {
      std::this_thread::sleep_for(20ms);
      sink.held = false;
    });
  }
}

}  // namespace
}  // namespace mars::sinks
