#include "hal/nx/call_lock.h"

namespace mars::hal {

void CallLock::need(std::mutex* mutex) {
  if (depth_ > 0 && mutex_ != nullptr) mutex_->unlock();
  mutex_ = mutex;
  if (depth_ > 0 && mutex_ != nullptr) mutex_->lock();
}

}  // namespace mars::hal
