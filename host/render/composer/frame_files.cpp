#include "host/render/composer/frame_files.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "node/wire/frame_writer.h"

namespace mars::composer {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

FrameFiles::FrameFiles(std::int32_t node, NameOf name_of, Put put, sinks::Patience::Bounds bounds)
    : node_(node),
      name_of_(std::move(name_of)),
      put_(std::move(put)),
      patience_([&] {
        bounds.warn = [this](const std::string& line) {
          const std::lock_guard lock(mutex_);
          warnings_.push_back(line);
        };
        return bounds;
      }()),
      thread_([this] { work(); }) {}

FrameFiles::~FrameFiles() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  change_.notify_all();
  patience_.give_up();
  thread_.join();
}

bool FrameFiles::is_full() {
  const std::lock_guard lock(mutex_);
  return under_way_ >= wire::kMostFilesUnderWay;
}

void FrameFiles::write(FrameFile file) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(file));
    ++under_way_;
  }
  change_.notify_all();
}

bool FrameFiles::is_busy() {
  const std::lock_guard lock(mutex_);
  return under_way_ > 0 || !written_.empty() || !warnings_.empty() || failure_ != nullptr;
}

std::optional<wire::Written> FrameFiles::take_written() {
  if (!has_written()) patience_.check();
  const std::lock_guard lock(mutex_);
  if (written_.empty() && failure_) std::rethrow_exception(failure_);
  if (written_.empty()) return std::nullopt;
  const wire::Written written = written_.front();
  written_.pop_front();
  return written;
}

bool FrameFiles::has_written() {
  const std::lock_guard lock(mutex_);
  return !written_.empty();
}

std::optional<std::string> FrameFiles::take_warning() {
  const std::lock_guard lock(mutex_);
  if (warnings_.empty()) return std::nullopt;
  std::string warning = std::move(warnings_.front());
  warnings_.pop_front();
  return warning;
}

std::vector<std::byte> FrameFiles::buffer() {
  const std::lock_guard lock(mutex_);
  if (spare_.empty()) return {};
  std::vector<std::byte> buffer = std::move(spare_.back());
  spare_.pop_back();
  return buffer;
}

void FrameFiles::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    change_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    write_next(lock);
  }
}

void FrameFiles::write_next(std::unique_lock<std::mutex>& lock) {
  FrameFile file = std::move(waiting_.front());
  waiting_.pop_front();
  lock.unlock();
  const auto begun = Clock::now();
  std::exception_ptr failure;
  try {
    patience_.write(name_of_(file.frame), [&] { put_(file); });
  } catch (...) {
    failure = std::current_exception();
  }
  wire::Written written{
      file.frame, node_, {}, file.bytes.size(), std::chrono::duration<double>(Clock::now() - begun).count()};
  std::copy_n(file.pixel_hash.begin(), std::min(file.pixel_hash.size(), written.pixel_hash.size() - 1),
              written.pixel_hash.begin());
  file.bytes.clear();
  lock.lock();
  --under_way_;
  if (failure && !failure_) failure_ = failure;
  if (!failure) written_.push_back(written);
  spare_.push_back(std::move(file.bytes));
}

}  // namespace mars::composer
