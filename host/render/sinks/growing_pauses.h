// How long to wait before looking again at what other machines keep: short at first, as most waits are; then longer, so
// that many waiting processes are no load. A random part keeps processes that began together apart.
#pragma once

#include <chrono>
#include <random>

namespace mars::sinks {

class GrowingPauses {
 public:
  // From half of 2 ms to 2 ms, then of twice as much each time, up to 100 ms.
  std::chrono::microseconds next();

 private:
  std::minstd_rand random_{std::random_device{}()};
  std::chrono::microseconds longest_{2000};
};

}  // namespace mars::sinks
