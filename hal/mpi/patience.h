// How a process waits for MPI, which offers no way to sleep: it looks again, first at once, then after others had
// the processor, then after sleeps that grow with the wait to about ten milliseconds and that a bell (bells.h) ends.
// So a short wait costs microseconds and a long one hardly any processor time.
#pragma once

#include <chrono>
#include <optional>

namespace mars::mpi {

// Makes the short sleeps of this thread short: Linux adds 50 microseconds to each by default.
void prepare_to_wait();

// How long to sleep in turn 0, 1, 2 ... of one wait; 0: only give the processor to others; none: look again at
// once. `oversubscribed`: there are more processes than processors, so the process that is waited for may itself wait
// for this processor. `crowded`: as Crowd says.
std::optional<std::chrono::microseconds> pause_of(int turn, bool oversubscribed, bool crowded);

// The first turns, in which pause_of says none.
int turns_at_once(bool oversubscribed);

// Whether others take the processor for so long that a rank waits better asleep: Linux gives it back soon to a process
// that wakes, but to one that has yielded, as Open MPI does after each look where there are more ranks than slots, only
// after the turns of all others. With 30 busy processes on 2 processors a yield takes 200 milliseconds, a sleep 25.
class Crowd {
 public:
  // A yield or a look has lasted from `begun` until `now`, seconds.
  void note(double begun, double now);
  // Until when it is taken for granted; then yields and looks show whether it is there still.
  double until() const { return until_; }

 private:
  double until_ = 0;
};

// Whether MPI's own waiting takes no processor, as where SimGrid simulates ranks, whose time is MPI's then.
bool mpi_waits_well();

}  // namespace mars::mpi
