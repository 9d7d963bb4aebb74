// Clocks, and what waiting costs.
#include <sys/resource.h>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

// Of the calling thread.
double processor_seconds() {
  rusage usage = {};
  getrusage(RUSAGE_THREAD, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

RULE(clocks_go_on, "dclock counts seconds and mclock milliseconds", "neither stands still while a process sleeps") {
  const double seconds = dclock();
  const unsigned long milliseconds = mclock();
  let_pass(0.005);
  expect(dclock() - seconds >= 0.0049, "dclock went on");
  expect(mclock() - milliseconds >= 4, "mclock went on");
}

RULE(hwclock_is_dclock, "hwclock counts the same time as dclock, in nanoseconds, in two parts of 32 bits",
     "neither clock is ahead of the other") {
  const double before = dclock();
  esize_t ticks = {-1, -1};
  hwclock(&ticks);
  const double after = dclock();
  expect(ticks.slow >= 0 && ticks.slow <= 0xffffffffL, "the lower part is 32 bits");
  const double now = (static_cast<double>(ticks.shigh) * 4294967296.0 + static_cast<double>(ticks.slow)) * 1e-9;
  expect(now >= before - 1e-6 && now <= after + 1e-6, "it is the time of dclock");
}

// Where more ranks wait than there are processors none can take much of them: it would show nothing.
bool there_are_few() { return numnodes() == 1 || numnodes() == 3; }

RULE(waiting_costs_little, "a rank that waits for a message leaves the processor to others",
     "0.2 s of waiting take less than 0.07 s of the processor") {
  if (!there_are_few()) return;
  const double before = processor_seconds();
  if (mynode() == 0) {
    let_pass(0.2);
    send_empty(95, myhost());
    send_empty(95, -1);
  } else {
    receive_empty(95);
    expect(processor_seconds() - before < 0.07, "0.2 s of waiting took less than 0.07 s");
  }
}

RULE(flick_gives_time_away, "flick yields the processor", "a loop of flick does not keep a processor busy") {
  if (!there_are_few()) return;
  const double before = processor_seconds();
  const double end = dclock() + 0.15;
  while (dclock() < end) flick();
  expect(processor_seconds() - before < 0.05, "0.15 s of flick took less than 0.05 s");
}

}  // namespace
}  // namespace mars::conformance
