// Where a pixel's samples are: as many sub-scanlines as samples, evenly apart, on each one sample of every pixel at an
// x of its own (n-rooks). Plain structs: kernels of several instruction sets share them.
#pragma once

#include <cstdint>

namespace mars::shape {

inline constexpr int kMostSamples = 16;

// Places within the pixel, 1/256 pixel, from the upper sub-scanline on. A picture's sub-scanlines are its rows: sample
// s of the pixels on line l is on row count * l + s.
struct SamplePattern {
  std::int32_t count;
  std::int32_t log2_count;
  std::int32_t x[kMostSamples];
  std::int32_t y[kMostSamples];
  // The samples from the pixel's centre outwards, equally far ones from above. Where several share one shading, it is
  // that of the first of them.
  std::uint8_t by_distance[kMostSamples];
};

// `samples`: 1, 2, 4, 8 or 16.
const SamplePattern& sample_pattern(std::uint32_t samples);

}  // namespace mars::shape
