// The scanline z-buffer: edge boxes into place by counting sort, then line by line visibility first and
// shading after, so that hidden samples are never shaded.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "node/arena.h"
#include "node/kernels.h"
#include "node/mapping.h"
#include "node/strip_buffer.h"

namespace mars::node {

// The triangles of one frame on one node, and from each sender their crossings: first those that stand still,
// then those that move, each in the order of polygon numbers.
struct Polygons {
  struct Source {
    std::uint32_t first;  // where this sender's triangles begin; its crossings count from there
    std::span<const Crossing> stationary;  // the last comes first
    std::span<const Crossing> moving;
  };
  const Triangle* triangles;
  std::span<const Source> sources;
};

// Edge boxes of lines [lines.first, lines.last): line by line the stationary ones, then the moving ones, each
// in the order of polygon numbers, so that drawing in order settles depth ties.
struct LineBoxes {
  LineRange lines;
  std::span<const EdgeBox> boxes;
  std::span<const std::uint64_t> end;         // of each line's boxes
  std::span<const std::uint64_t> stationary_end;  // of each line's stationary boxes

  std::span<const EdgeBox> stationary(std::uint32_t line) const;
  std::span<const EdgeBox> moving(std::uint32_t line) const;
};

// `ebc`: running totals by line, as in mapping.h; they are the sort's offsets. Crossings of other lines are left
// out. Takes its arrays from `arena`. check()s that the boxes are exactly those that EBC counted.
LineBoxes fill_lines(const Polygons& polygons, const LineRange& lines, std::span<const std::uint64_t> ebc,
                     Arena& arena);

// The z-buffer: CZB for the whole picture, kept through an interval, and one line of MZB.
class ZBuffer {
 public:
  ZBuffer(const Kernels& kernels, std::int32_t width, std::int32_t height);

  // Draws stationary parts to CZB and their pixels (CFB) to `out`. Lines without any are cleared.
  void draw_stationary(const LineBoxes& boxes, const Shading& shading, StripBuffer& out);
  // Draws moving parts against CZB and MZB; their visible pixels (MFB) to `out`. CZB stays as it is.
  void draw_moving(const LineBoxes& boxes, const Shading& shading, StripBuffer& out);

  // CZB: 1 / w a sample, 0 where nothing stands; line after line.
  std::span<float> depth(const LineRange& lines);

 private:
  void shade_line(const Shading& shading, std::uint32_t line, Extent extent, StripBuffer& out);

  const Kernels& kernels_;
  std::size_t width_;
  std::vector<float> constant_;
  std::vector<float> moving_;
  std::vector<std::uint32_t> ids_;
};

}  // namespace mars::node
