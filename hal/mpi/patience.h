// How a process waits that MPI gives no way to sleep on: it looks again, first at once, then after others had
// the processor, then after sleeps that grow with the wait up to a millisecond. So a short wait costs
// microseconds and a long one hardly any processor time.
#pragma once

namespace mars::hal {

// Makes the short sleeps of this thread short: Linux adds 50 microseconds to each unless told not to.
void prepare_to_wait();

// Turn 0, 1, 2 ... of one wait. `oversubscribed`: there are more processes than processors, so whatever is
// waited for may itself wait for this processor.
void wait_a_turn(int turn, bool oversubscribed);

}  // namespace mars::hal
