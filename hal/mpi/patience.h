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
// for this processor.
std::optional<std::chrono::microseconds> pause_of(int turn, bool oversubscribed);

// The first turns, in which pause_of says none.
int turns_at_once(bool oversubscribed);

// Whether MPI's own waiting takes no processor, as where SimGrid simulates ranks, whose time is MPI's then.
bool mpi_waits_well();

}  // namespace mars::mpi
