// Whose turn it is to run: a rank's thread sleeps until it gets its turn. Not std::binary_semaphore: libstdc++'s yields
// the processor before it sleeps, and then waits behind all that runs beside.
#pragma once

#include <semaphore.h>

namespace mars::simulated {

class Turn {
 public:
  Turn() { sem_init(&semaphore_, 0, 0); }
  ~Turn() { sem_destroy(&semaphore_); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  void release() { sem_post(&semaphore_); }
  void acquire() {
    while (sem_wait(&semaphore_) != 0) continue;  // a signal came
  }

 private:
  sem_t semaphore_;
};

}  // namespace mars::simulated
