#include "hal/nx/call_lock.h"

namespace mars::nx {

void CallLock::need(std::mutex* mutex) {
  if (depth_ > 0 && mutex_ != nullptr) mutex_->unlock();
  mutex_ = mutex;
  if (depth_ > 0 && mutex_ != nullptr) mutex_->lock();
}

}  // namespace mars::nx
