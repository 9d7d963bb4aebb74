#include "hal/nx/progress_thread.h"

#include <chrono>
#include <exception>

#include "hal/failure/explain.h"
#include "hal/nx/call_lock.h"
#include "hal/nx/guard.h"

namespace mars::nx {
namespace {

constexpr std::chrono::microseconds kRest{500};

}  // namespace

ProgressThread::ProgressThread(messages::Process& process) : process_(process) {
  CallLock::need(&calls_);
  thread_ = std::thread([this] { run(); });
}

ProgressThread::~ProgressThread() {
  CallLock::need(nullptr);
  {
    const std::lock_guard lock(ending_mutex_);
    ending_ = true;
  }
  ending_news_.notify_one();
  if (thread_.get_id() == std::this_thread::get_id())
    thread_.detach();  // its handler ends the program
  else
    thread_.join();
}

// False at the end.
bool ProgressThread::rest() {
  std::unique_lock lock(ending_mutex_);
  return !ending_news_.wait_for(lock, kRest, [this] { return ending_; });
}

void ProgressThread::run() try {
  process_.serve_this_thread();
  while (rest()) {
    if (!calls_.try_lock()) continue;
    const std::lock_guard lock(calls_, std::adopt_lock);
    plain([this] { process_.attend(); });
  }
} catch (const std::exception& failure) {
  try {
    process_.backend().abort(reason_of(failure));
  } catch (const std::exception&) {
    // The threads backend throws it in run_threads, too.
  }
}

}  // namespace mars::nx
