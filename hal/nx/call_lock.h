// Who has a progress thread (progress_thread.h) makes each of its NX calls under a mutex, so that the thread
// calls only between them. Others pay for two counts. A handler's calls are within a call, and so hold it
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
