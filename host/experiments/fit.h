// What units of work cost, from measured times: non-negative least squares of relative errors. Times that no costs
// explain, as where something else ran on the machine, are left out. Where units of one kind nearly follow from those
// of others, times cannot say which of them cost what.
#pragma once

#include <span>
#include <vector>

namespace mars::experiments {

struct Measurement {
  std::vector<double> units;  // by kind, the same kinds in all
  double seconds;
};

struct Fit {
  std::vector<double> costs;  // by kind, seconds a unit
  double median_error = 0;    // |predicted / measured - 1|, of all measurements
  double high_error = 0;      // that nine of ten stay below
};

// `soft`: an error in seconds counts relative to the measured seconds and these.
Fit fit_costs(std::span<const Measurement> measurements, double soft);

// By kind: the part of its units, squared and weighed as errors are, that a sum of other kinds' units explains. 1: all
// of them, or there are none.
std::vector<double> explained_by_others(std::span<const Measurement> measurements, double soft);

}  // namespace mars::experiments
