// The scanline z-buffer: edge boxes into place by counting sort, then line by line visibility first and
// shading after, so that hidden samples are never shaded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/raster/arena.h"
#include "node/raster/czb.h"
#include "node/raster/kernels.h"
#include "node/raster/strip_buffer.h"
#include "node/shading/kernels.h"

namespace mars::raster {

// One sender's part of a frame's triangles.
struct Polygons {
  const geometry::Triangle* triangles;
  std::span<const UnsortedEdgeBox> stationary;
  std::span<const UnsortedEdgeBox> moving;
};

// Edge boxes of lines [lines.first, lines.last): line by line the stationary ones, then the moving ones.
struct LineBoxes {
  geometry::LineRange lines;
  std::span<const EdgeBox> boxes;
  std::span<const std::uint64_t> end;             // of each line's boxes
  std::span<const std::uint64_t> stationary_end;  // of each line's stationary boxes

  std::span<const EdgeBox> stationary(std::uint32_t line) const;
  std::span<const EdgeBox> moving(std::uint32_t line) const;
  bool any_stationary() const;
};

// Puts edge boxes into their lines: a counting sort whose offsets are EBC's running totals. Senders may be
// added in any order; edge boxes of other lines are left out.
class LineFiller {
 public:
  // Boxes will name triangles by their distance from `first`. Takes its arrays from `arena`.
  LineFiller(const geometry::LineRange& lines, std::span<const std::uint64_t> ebc, const geometry::Triangle* first,
             Arena& arena);

  void add(const Polygons& polygons);
  // check()s that the boxes are exactly those that EBC counted.
  LineBoxes finish() const;

 private:
  geometry::LineRange lines_;
  const geometry::Triangle* first_;
  std::span<EdgeBox> boxes_;
  std::span<std::uint64_t> end_;
  std::span<std::uint64_t> stationary_;  // each line's from its begin, growing
  std::span<std::uint64_t> moving_;      // and from its end, falling
};

// The z-buffer of the line that is being drawn, small enough for a core's first cache.
class ZBuffer {
 public:
  ZBuffer(simd::InstructionSet set, std::int32_t width);

  // Draws lines [part.first, part.last) of `boxes`: stationary parts (CFB), and against them the moving ones (MFB).
  // CZB of `czb_lines` goes to `czb`.
  void draw_keyframe(const LineBoxes& boxes, const geometry::LineRange& part, const shading::Shading& shading,
                     const geometry::LineRange& czb_lines, Czb& czb, StripBuffer& out);
  // Draws moving parts of these lines against `czb`, whose `czb_lines` have all of them, and each other.
  void draw_inbetween(const LineBoxes& boxes, const geometry::LineRange& part, const shading::Shading& shading,
                      const geometry::LineRange& czb_lines, Czb& czb, StripBuffer& out);

 private:
  // Samples, as many as kernels take at a time.
  struct alignas(64) Depths {
    float samples[simd::kVectorSlack];
  };
  struct alignas(64) Ids {
    std::uint32_t samples[simd::kVectorSlack];
  };

  void draw(std::span<const EdgeBox> boxes, const shading::Shading& shading, std::uint32_t line,
            StripBuffer::Layer& out);

  float* depth() { return depths_.front().samples; }
  std::uint32_t* ids() { return ids_.front().samples; }

  const RasterKernels& kernels_;
  const shading::ShadingKernels& shading_kernels_;
  std::size_t width_;
  std::vector<Depths> depths_;  // kVectorSlack samples more than a line
  std::vector<Ids> ids_;        // likewise; kNoTriangle between lines
};

}  // namespace mars::raster
