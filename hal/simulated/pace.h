// How long work takes on the computers of a machine, which differ: some kinds are faster than others, some computers
// are slower than their kind, and now and then the system takes a processor away. All of it follows from the platform,
// a seed and the simulated time, so it is the same whoever asks in which order, and however work is cut into pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/simulated/machine.h"

namespace mars::simulated {

class Pace {
 public:
  struct Processor {
    int computer;
    int number;  // on the computer
  };

  // `machine` lasts. Of `computers` computers of nodes; the next number is that of the host, if it is apart.
  Pace(const Machine& machine, int computers);
  Pace(const Machine&&, auto&&...) = delete;

  // When work is done that begins at `begin` and takes `seconds` on a computer of speed 1.
  double end(Processor processor, double begin, double seconds) const;

 private:
  double after_detours(Processor processor, double begin, double end) const;

  const Machine& machine_;
  std::vector<double> slowness_;  // by computer, how many times as long work takes
};

}  // namespace mars::simulated
