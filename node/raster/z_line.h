// The z-buffer of one line of pixels, small enough for a core's caches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/raster/kernels.h"
#include "node/raster/line_boxes.h"
#include "node/simd/vector_slack.h"

namespace mars::raster {

inline constexpr shading::Extent kNothing{0xffffffffu, 0};

inline bool is_empty(const shading::Extent& extent) { return extent.first >= extent.last; }
shading::Extent both(const shading::Extent& a, const shading::Extent& b);

using BoxesOf = std::span<const EdgeBox> (LineBoxes::*)(std::uint32_t line) const;

bool any_boxes(LineParts parts, BoxesOf kind, std::uint32_t line);
// Columns that moving parts' boxes span.
shading::Extent moving_extent(LineParts parts, std::uint32_t line);

// Depths are `nothing` (shape::Projection) and ids kNoTriangle between lines.
class ZLine {
 public:
  ZLine(simd::InstructionSet set, std::uint32_t width, const shape::SamplePattern& pattern, float nothing = 0);

  // Draws the line's edge boxes of one kind over what is there; says which columns they span.
  shading::Extent draw(LineParts parts, BoxesOf kind, const geometry::Triangle* triangles, std::uint32_t line);

  float nothing() const { return nothing_; }
  std::uint32_t samples_a_pixel() const { return static_cast<std::uint32_t>(pattern_.count); }
  LineSamples samples() { return {depths_.front().samples, ids_.front().samples, stride_}; }
  float* depth(std::uint32_t sample) { return depths_.front().samples + sample * stride_; }
  std::uint32_t* ids(std::uint32_t sample) { return ids_.front().samples + sample * stride_; }
  void forget_depths(const shading::Extent& extent);
  void forget_ids(const shading::Extent& extent);

 private:
  // Samples, as many as kernels take at a time.
  struct alignas(64) Depths {
    float samples[simd::kVectorSlack];
  };
  struct alignas(64) Ids {
    std::uint32_t samples[simd::kVectorSlack];
  };

  const RasterKernels& kernels_;
  shape::SamplePattern pattern_;
  float nothing_;
  std::uint32_t stride_;        // samples of a row, with kVectorSlack to spare
  std::vector<Depths> depths_;  // row by row
  std::vector<Ids> ids_;        // of the same samples
};

}  // namespace mars::raster
