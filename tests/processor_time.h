// Seconds of processors that this process has taken since the object began. What else the machine does does not count,
// so that tests may bound them.
#pragma once

#include <ctime>

namespace mars::test {

class ProcessorTime {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace mars::test
