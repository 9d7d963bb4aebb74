#include "tests/bench/peers/frame_files.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace mars::bench {
namespace {

constexpr int kFewestThreads = 2;
constexpr std::size_t kMoreBuffers = 2;

int thread_count() {
  cpu_set_t processors;
  if (sched_getaffinity(0, sizeof processors, &processors) != 0) return kFewestThreads;
  return std::max(kFewestThreads, CPU_COUNT(&processors));
}

bool write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = write(file, bytes.data(), bytes.size());
    if (done < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
  return true;
}

void write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  bool fine = file >= 0 && write_all(file, bytes) && fsync(file) == 0;
  fine = file >= 0 && close(file) == 0 && fine;
  if (!fine) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

FrameFiles::FrameFiles(std::string folder, const std::string& encoder, std::uint32_t width, std::uint32_t height)
    : folder_(std::move(folder)), encoder_(encoder), width_(width), height_(height) {
  make_png_encoder(encoder, 1, 1);  // fails where there is none
  const int threads = thread_count();
  buffers_.resize(static_cast<std::size_t>(threads) + kMoreBuffers);
  for (std::size_t k = 0; k < buffers_.size(); ++k) {
    buffers_[k].pixels.resize(std::size_t{width} * height);
    free_.push_back(k);
  }
  for (int k = 0; k < threads; ++k) threads_.emplace_back([this] { work(); });
}

FrameFiles::~FrameFiles() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

std::size_t FrameFiles::free_buffer() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || !free_.empty(); });
  if (failure_) std::rethrow_exception(failure_);
  const std::size_t buffer = free_.back();
  free_.pop_back();
  return buffer;
}

void FrameFiles::submit(std::size_t buffer) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(buffer);
  }
  changed_.notify_all();
}

void FrameFiles::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || free_.size() == buffers_.size(); });
  if (failure_) std::rethrow_exception(failure_);
}

void FrameFiles::work() {
  const std::unique_ptr<PngEncoder> encoder = make_png_encoder(encoder_, width_, height_);
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    const std::size_t buffer = waiting_.front();
    waiting_.pop_front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      write(*encoder, buffers_[buffer]);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) failure_ = failure;
    free_.push_back(buffer);
    changed_.notify_all();
  }
}

void FrameFiles::write(PngEncoder& encoder, const FrameBuffer& frame) const {
  char name[32];
  std::snprintf(name, sizeof name, "/frame-%04u.png", frame.number);
  write_file(folder_ + name, encoder.encode(frame.pixels));
}

}  // namespace mars::bench
