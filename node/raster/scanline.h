// The scanline z-buffer, a line of pixels at a time: visibility first and shading after, so that hidden samples are
// never shaded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/raster/kernels.h"
#include "node/raster/line_boxes.h"
#include "node/raster/pixel_groups.h"
#include "node/raster/still_lines.h"
#include "node/raster/strip_buffer.h"
#include "node/shading/kernels.h"

namespace mars::raster {

// What was done since it was asked last.
struct DrawnCounts {
  std::uint64_t lines = 0;
  std::uint64_t still_bytes = 0;
  shading::ShadedCounts shaded{};
};

// The z-buffer of the line that is being drawn, small enough for a core's caches.
class ZBuffer {
 public:
  ZBuffer(simd::InstructionSet set, std::uint32_t width, const shape::SamplePattern& pattern);

  // Draws `lines`: what stands still (CFB), and against it what moves (MFB). Lines of `still` are written to it.
  void draw_keyframe(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                     StillLines& still, StripBuffer& out);
  // Draws what moves on these lines against `still` and each other. On lines that it does not keep the parts have what
  // stands still too; says on how many this was drawn again.
  std::uint32_t draw_inbetween(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                               StillLines& still, StripBuffer& out);

  DrawnCounts take_counts() { return std::exchange(counts_, {}); }

 private:
  // Samples, as many as kernels take at a time.
  struct alignas(64) Depths {
    float samples[simd::kVectorSlack];
  };
  struct alignas(64) Ids {
    std::uint32_t samples[simd::kVectorSlack];
  };

  using BoxesOf = std::span<const EdgeBox> (LineBoxes::*)(std::uint32_t line) const;

  std::uint32_t samples_a_pixel() const { return static_cast<std::uint32_t>(pattern_.count); }
  bool several() const { return pattern_.count > 1; }
  void draw_line(LineParts parts, const shading::Shading& shading, std::uint32_t line, StillLines& still,
                 StripBuffer& out);
  shading::Extent draw_still_again(LineParts parts, const shading::Shading& shading, std::uint32_t line);
  // Over what stands still. Says which columns the boxes span, as does draw.
  shading::Extent draw_moving(LineParts parts, const shading::Shading& shading, std::uint32_t line,
                              const StillGroups& still, StripBuffer& out);
  shading::Extent draw(LineParts parts, BoxesOf kind, const shading::Shading& shading, std::uint32_t line);

  // Keeps a line's depths and has its groups kept, if they are needed and fit; says where the groups are to go.
  StillGroups keep(std::uint32_t line, StillLines& still);
  StillGroups own_still() { return {still_end_.data(), still_groups_.data()}; }
  void take_depths(std::uint32_t line, const shading::Extent& extent, StillLines& still);
  void shade_groups(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent);
  void put_samples(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent,
                   StripBuffer::Layer& out);
  void forget_depths(const shading::Extent& extent);
  void forget_ids(const shading::Extent& extent);

  LineSamples samples() { return {depths_.front().samples, ids_.front().samples, stride_}; }
  float* depth(std::uint32_t sample) { return depths_.front().samples + sample * stride_; }
  std::uint32_t* ids(std::uint32_t sample) { return ids_.front().samples + sample * stride_; }

  const RasterKernels& kernels_;
  const shading::ShadingKernels& shading_kernels_;
  shape::SamplePattern pattern_;
  std::uint32_t stride_;        // samples of a row, with kVectorSlack to spare
  std::vector<Depths> depths_;  // row by row; 0 between lines
  std::vector<Ids> ids_;        // of the same samples; kNoTriangle between lines
  PixelGroups groups_;          // of the kind that is being drawn
  // The line's still groups, where inbetweens do not need them or they are not kept.
  std::vector<std::uint32_t> still_end_;
  std::vector<StillGroup> still_groups_;
  DrawnCounts counts_;
};

}  // namespace mars::raster
