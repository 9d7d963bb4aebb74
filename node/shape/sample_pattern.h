// Where a pixel's samples are: as many sub-scanlines as samples, evenly apart, on each one sample of every pixel at an
// x of its own (n-rooks). Plain structs: kernels of several instruction sets share them.
#pragma once

#include <cstdint>

namespace mars::shape {

inline constexpr int kMostSamples = 16;

// Places within the pixel, 1/256 pixel; samples are numbered from the upper sub-scanline on. A picture's sub-scanlines
// are its rows: row count * line + sample.
struct SamplePattern {
  std::int32_t count;
  std::int32_t log2_count;
  std::int32_t x[kMostSamples];
  std::int32_t y[kMostSamples];
};

// `samples`: 1, 2, 4, 8 or 16.
const SamplePattern& sample_pattern(std::uint32_t samples);

}  // namespace mars::shape
