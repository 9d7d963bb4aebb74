#include "host/render/sinks/sink_pool.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"

namespace mars::sinks {

namespace {

constexpr std::chrono::milliseconds kLook{200};  // how often the sink is asked whether it still answers

}  // namespace

SinkPool::SinkPool(Sink& sink, const Shape& shape) : SinkPool(sink, shape, NoThreads()) { start_threads(); }

SinkPool::SinkPool(Sink& sink, const Shape& shape, NoThreads) : sink_(sink), shape_(shape) {
  check(shape.frames >= 1 && shape.threads >= 1, "a sink pool has a frame and a thread");
  make_frame();  // the first does not wait for fresh memory
}

// Where the machine gives fewer, these do the work.
void SinkPool::start_threads() {
  threads_.reserve(shape_.threads);
  try {
    for (std::uint32_t i = 0; i < shape_.threads; ++i) threads_.emplace_back([this, i] { work(i); });
  } catch (const std::exception&) {
    if (threads_.empty()) throw;
  }
}

SinkPool::~SinkPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    waiting_.clear();
  }
  submitted_.notify_all();
  sink_.give_up();
  for (std::thread& thread : threads_) thread.join();
}

void SinkPool::make_frame() {
  frames_.push_back(
      std::make_unique<compositor::Frame>(shape_.width, shape_.height, shape_.block, shape_.background, shape_.format));
  const std::lock_guard lock(mutex_);
  free_.push_back(frames_.back().get());
}

compositor::Frame* SinkPool::free_frame(std::uint64_t background) { return take_free(background, 0); }

compositor::Frame* SinkPool::early_frame(std::uint64_t background) {
  return take_free(background, std::max<std::size_t>(1, shape_.frames / 2));
}

// One of the free frames, if more than `left` are.
compositor::Frame* SinkPool::take_free(std::uint64_t background, std::size_t left) {
  std::unique_lock lock(mutex_);
  throw_failure();
  if (free_.size() + shape_.frames - frames_.size() <= left) return nullptr;
  if (free_.empty()) {
    lock.unlock();
    make_frame();
    lock.lock();
  }
  // The one given back last is the likeliest to be in a cache still.
  const auto shows_it = [&](const compositor::Frame* frame) { return frame->background == background; };
  auto best = std::find_if(free_.rbegin(), free_.rend(), shows_it);
  if (best == free_.rend()) best = free_.rbegin();
  std::swap(*best, free_.back());
  compositor::Frame* frame = free_.back();
  free_.pop_back();
  return frame;
}

void SinkPool::give_back(compositor::Frame* frame) {
  frame->shown.reset();
  const std::lock_guard lock(mutex_);
  free_.push_back(frame);
}

void SinkPool::submit(compositor::Frame* frame) {
  {
    const std::lock_guard lock(mutex_);
    throw_failure();
    waiting_.push_back({frame, dclock()});
  }
  submitted_.notify_one();
}

std::vector<SinkPool::Taken> SinkPool::taken() {
  sink_.check();
  const std::lock_guard lock(mutex_);
  throw_failure();
  return std::exchange(taken_, {});
}

void SinkPool::finish() {
  std::unique_lock lock(mutex_);
  while (!idle_.wait_for(lock, kLook, [this] { return failure_ || (waiting_.empty() && busy_ == 0); })) sink_.check();
  throw_failure();
}

void SinkPool::work(std::uint32_t thread) {
  std::unique_lock lock(mutex_);
  while (true) {
    submitted_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    take(lock, thread);
    idle_.notify_all();
  }
}

void SinkPool::take(std::unique_lock<std::mutex>& lock, std::uint32_t thread) {
  const auto [frame, submitted] = waiting_.front();
  waiting_.pop_front();
  ++busy_;
  lock.unlock();
  const double begun = dclock();
  std::exception_ptr failure;
  try {
    sink_.take(*frame);
  } catch (...) {
    failure = std::current_exception();
  }
  const double ended = dclock();
  frame->shown.reset();
  lock.lock();
  --busy_;
  free_.push_back(frame);
  if (!failure) taken_.push_back({frame->number, thread, submitted, begun, ended});
  if (failure && !failure_) failure_ = failure;
}

void SinkPool::throw_failure() {
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace mars::sinks
