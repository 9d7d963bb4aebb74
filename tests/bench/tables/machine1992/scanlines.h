// The second phase of the scanline z-buffer: each edge box of a line pixel by pixel, first the stationary ones, then
// against these the moving ones. The 1992 program shades a pixel whenever it is the nearest so far; this counts so, and
// shades what is seen in the end by the product's kernels.
#pragma once

#include <cstdint>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/raster/line_load.h"
#include "node/shading/kernels.h"
#include "tests/bench/tables/machine1992/edge_lists.h"
#include "tests/bench/tables/machine1992/frame_buffers.h"
#include "tests/bench/tables/machine1992/work.h"

namespace mars::machine1992 {

class Scanlines {
 public:
  explicit Scanlines(std::uint32_t width);

  // CFB and CZB of `lines`, which were clear.
  void draw_stationary(const EdgeLists& lists, const geometry::LineRange& lines, shading::Shading shading,
                       FrameBuffers& buffers, WorkCounts& work);
  // MFB and MZB of `lines`, which were clear, where they are nearer than CZB.
  void draw_moving(const EdgeLists& lists, const geometry::LineRange& lines, shading::Shading shading,
                   FrameBuffers& buffers, WorkCounts& work);

 private:
  // `behind`: depths that a pixel must be nearer than, beside the layer's own; may be none.
  void draw_line(const EdgeLists& lists, std::uint32_t first, std::uint32_t line, const shading::Shading& shading,
                 const float* behind, Layer& layer, WorkCounts& work);
  void draw_box(const geometry::Triangle* triangles, std::uint32_t number, const EdgeLists::EdgeBox& box,
                std::uint32_t line, const float* behind, float* depths, WorkCounts& work);
  void shade(const shading::Shading& shading, std::uint32_t line, std::span<std::uint32_t> pixels);

  const shading::ShadingKernels& kernels_;
  std::uint32_t width_;
  std::vector<std::uint32_t> ids_;  // of one line; with slack for kernels
  std::vector<wire::Run> runs_;
  std::vector<std::uint32_t> shaded_;
};

}  // namespace mars::machine1992
