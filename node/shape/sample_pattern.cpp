#include "node/shape/sample_pattern.h"

#include <bit>

#include "hal/failure/failure.h"

namespace mars::shape {
namespace {

// `columns`: of each sample, of as many columns as there are samples; any two of a permutation differ.
template <int kCount>
constexpr SamplePattern pattern_of(const int (&columns)[kCount]) {
  SamplePattern pattern{kCount, std::countr_zero(static_cast<unsigned>(kCount)), {}, {}};
  for (int s = 0; s < kCount; ++s) {
    pattern.x[s] = (2 * columns[s] + 1) * 128 / kCount;
    pattern.y[s] = (2 * s + 1) * 128 / kCount;
  }
  return pattern;
}

// Neighbouring sub-scanlines have samples far apart, also across the border of two pixels, and none of the patterns has
// three samples close to a line at a small angle to the axes.
constexpr SamplePattern kOne = pattern_of({0});
constexpr SamplePattern kTwo = pattern_of({0, 1});
constexpr SamplePattern kFour = pattern_of({1, 3, 0, 2});
constexpr SamplePattern kEight = pattern_of({3, 6, 1, 4, 7, 2, 5, 0});
constexpr SamplePattern kSixteen = pattern_of({6, 13, 2, 9, 0, 11, 4, 15, 7, 12, 1, 10, 3, 14, 5, 8});

}  // namespace

const SamplePattern& sample_pattern(std::uint32_t samples) {
  switch (samples) {
    case 1: return kOne;
    case 2: return kTwo;
    case 4: return kFour;
    case 8: return kEight;
    default: check(samples == kMostSamples, "a pixel has 1, 2, 4, 8 or 16 samples"); return kSixteen;
  }
}

}  // namespace mars::shape
