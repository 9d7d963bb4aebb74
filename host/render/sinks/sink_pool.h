// A fixed number of frame buffers and of threads that hand finished frames to a sink: the host's memory is
// bounded, and its loop never waits for a file. The loop (one thread) asks for a free frame, composes it,
// submits it, and asks now and then which frames were taken, to give their credit back to the nodes.
// A sink's failure reaches the loop as an exception from whichever call of the loop comes next.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "host/render/sinks/sink.h"

namespace mars::sinks {

class SinkPool {
 public:
  struct Shape {
    std::uint32_t width;  // pixels
    std::uint32_t height;
    std::uint32_t block;           // side of a flag's block in pixels
    std::uint32_t frames;          // buffers at most, at least 1
    std::uint32_t threads;         // at least 1
    std::uint64_t background = 0;  // the pixel that new buffers show
    wire::PixelFormat format = wire::PixelFormat::rgb8;
  };

  // `sink` must outlive the pool.
  SinkPool(Sink& sink, const Shape& shape);
  // Waits for frames that a thread has begun, which then wait for storage no longer; those still queued are dropped.
  virtual ~SinkPool();
  SinkPool(const SinkPool&) = delete;
  SinkPool& operator=(const SinkPool&) = delete;

  const Shape& shape() const { return shape_; }
  // Whether frames may be submitted with stale blocks.
  virtual bool restores() const { return sink_.restores(); }

  // A frame to compose, the caller's until submitted, preferably one that shows the saved background of that
  // name; nullptr when all are with the sink.
  compositor::Frame* free_frame(std::uint64_t background = 0);
  // As free_frame(), for a frame that is long in the making: nullptr also where that left less than half of all, or
  // none, to frames that are soon submitted.
  compositor::Frame* early_frame(std::uint64_t background = 0);
  virtual void submit(compositor::Frame* frame);
  // A frame the sink has taken, and when, in seconds of dclock().
  struct Taken {
    std::uint32_t number;
    std::uint32_t thread;  // of the pool's
    double submitted;
    double begun;
    double ended;
  };
  // The frames taken since the last call.
  virtual std::vector<Taken> taken();
  // Of all frames taken so far.
  virtual images::FileWork made() const { return sink_.made(); }
  // Waits until every submitted frame was taken.
  virtual void finish();

 protected:
  // Without threads: a pool that takes frames in its own way.
  struct NoThreads {};
  SinkPool(Sink& sink, const Shape& shape, NoThreads);
  Sink& sink() { return sink_; }
  void give_back(compositor::Frame* frame);

 private:
  void make_frame();
  void start_threads();
  compositor::Frame* take_free(std::uint64_t background, std::size_t left);
  void work(std::uint32_t thread);
  void take(std::unique_lock<std::mutex>& lock, std::uint32_t thread);
  void throw_failure();

  Sink& sink_;
  const Shape shape_;
  std::vector<std::unique_ptr<compositor::Frame>> frames_;  // made as they are needed

  std::mutex mutex_;  // guards what follows
  std::condition_variable submitted_;
  std::condition_variable idle_;
  std::vector<compositor::Frame*> free_;
  struct Waiting {
    compositor::Frame* frame;
    double submitted;
  };
  std::deque<Waiting> waiting_;
  std::vector<Taken> taken_;
  std::size_t busy_ = 0;  // threads within the sink
  bool stop_ = false;
  std::exception_ptr failure_;

  std::vector<std::thread> threads_;
};

}  // namespace mars::sinks
