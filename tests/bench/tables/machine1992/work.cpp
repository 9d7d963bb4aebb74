#include "tests/bench/tables/machine1992/work.h"

#include "hal/messages/process.h"

namespace mars::machine1992 {

WorkCounts& WorkCounts::operator+=(const WorkCounts& other) {
  for (std::size_t k = 0; k < kWorks; ++k) units_[k] += other.units_[k];
  return *this;
}

void spend(const WorkCounts& work, WorkCounts& sum) {
  for (std::size_t k = 0; k < kWorks; ++k)
    if (const std::uint64_t units = work[static_cast<Work>(k)]; units > 0) messages::charge(static_cast<int>(k), units);
  sum += work;
}

}  // namespace mars::machine1992
