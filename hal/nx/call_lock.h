// With a progress thread (progress_thread.h) each NX call of a program runs under a mutex, so that the thread calls
// only between them. Other programs pay for two counts. A handler's calls are within a call, which holds the mutex
// already.
#pragma once

#include <mutex>

namespace mars::nx {

class CallLock {
 public:
  CallLock() {
    if (depth_++ == 0 && mutex_ != nullptr) mutex_->lock();
  }
  ~CallLock() {
    if (--depth_ == 0 && mutex_ != nullptr) mutex_->unlock();
  }
  CallLock(const CallLock&) = delete;
  CallLock& operator=(const CallLock&) = delete;

  // The calling thread's calls need `mutex` from now on, or none: nullptr. A call of it may be under way.
  static void need(std::mutex* mutex);

 private:
  static constinit inline thread_local int depth_ = 0;  // of calls within calls
  static constinit inline thread_local std::mutex* mutex_ = nullptr;
};

}  // namespace mars::nx
