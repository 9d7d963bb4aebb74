// Counts what a frame has to be drawn, as forecasts need it: makes its triangles as nodes do, forgets them share by
// share, and decides on some of its lines, or on all, what is seen. It shades nothing and sends nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hal/messages/private_memory.h"
#include "node/geometry/scene.h"
#include "node/geometry/sweep.h"
#include "node/raster/kernels.h"
#include "node/raster/line_load.h"
#include "node/raster/still_marks.h"
#include "node/shadow_counter.h"
#include "node/tessellator.h"
#include "node/wire/frame_counts.h"

namespace mars::node {

class FrameCounter {
 public:
  // The film's block outlives it. `is_exact`: visibility is decided on all lines.
  FrameCounter(const wire::PackedFilm& film, simd::InstructionSet set, bool is_exact = false);

  // Of frames of one interval, ascending, the first: what a group's nodes have together.
  wire::FrameCounts count_keyframe(std::uint32_t interval, std::span<const std::uint32_t> frames);
  // Of a frame of the interval whose keyframe was counted last.
  wire::FrameCounts count_inbetween(std::uint32_t frame);

 private:
  // On one of the lines where visibility is decided.
  struct SampledLine {
    std::vector<raster::EdgeBox> stationary, moving;
    std::vector<float> constant_depth;  // CZB of the interval, row by row of the pattern
  };
  struct Columns {
    std::uint32_t first = 0xffffffff;
    std::uint32_t last = 0;

    void add(std::uint32_t from, std::uint32_t to) { first = std::min(first, from), last = std::max(last, to); }
    double width() const { return first < last ? last - first : 0; }
  };

  // What lines show.
  struct Seen {
    std::vector<wire::SeenCounts> constant, moving;  // by sampled line
  };
  // Of a row of the host's blocks, by column, on how many lines its blocks have pixels, and are filled by them.
  struct BlockRow {
    std::vector<std::uint16_t> shown, filled;
  };
  using Visit = std::function<void(const Tessellation& made, const wire::WorkCounts& work)>;

  wire::FrameCounts count(wire::FrameKind kind, std::uint32_t frame);
  void note_marked(wire::FrameCounts& counts, double wire::LineCounts::*width) const;
  void make_all(bool keyframe, const Visit& visit);
  void make(const Scatter& scatter, bool keyframe, const Visit& visit);
  void add_share(const Tessellation& made, const wire::WorkCounts& work, wire::FrameCounts& counts);
  void mark_surfaces(const raster::Polygons& polygons, wire::FrameCounts& counts);
  wire::MadeSurface mark_surface(const SurfaceMark& mark, std::span<const raster::UnsortedEdgeBox> boxes,
                                 std::vector<wire::SurfaceLine>& lines);
  void forget_kept(const geometry::LineRange& lines);
  void keep_sampled(const Tessellation& made);
  void keep_sampled(std::span<const raster::UnsortedEdgeBox> boxes, const geometry::Triangle* triangles, bool moving);
  wire::UnitCounts units_of(const Tessellation& made, const wire::WorkCounts& work) const;
  std::uint32_t band_end(std::uint32_t first) const;
  void see_in_bands(bool keyframe, Seen& seen);
  void see(bool keyframe, Seen& seen);
  void end_block_rows(std::uint32_t line);
  void end_block_row(std::uint32_t line, BlockRow& row, std::vector<wire::BlockStretch>& stretches) const;
  void spread(const std::vector<wire::SeenCounts>& seen, std::vector<wire::LineCounts>& lines,
              wire::SeenCounts wire::LineCounts::*to, double (*samples_of)(const wire::LineCounts&)) const;
  void estimate_seen(wire::FrameCounts& counts, bool keyframe);
  BlockRow& row_of(shadow::Casting kind) { return kind == shadow::Casting::still ? constant_row_ : moving_row_; }
  wire::SeenCounts draw(shadow::Casting kind, std::span<const raster::EdgeBox> boxes, std::uint32_t line,
                        std::vector<float>& depths);

  void count_groups(std::uint32_t column, wire::SeenCounts& seen) const;
  void count_kept_groups(std::uint32_t line, const shading::Extent& extent, wire::SeenCounts& seen) const;

  std::uint32_t line_of(std::size_t sampled) const;

  geometry::Scene scene_;
  const geometry::ShapeBoxes boxes_;
  geometry::Sweep sweep_;  // of the interval
  raster::StillMarks marks_;
  Tessellator tessellator_;
  const raster::RasterKernels& kernels_;
  const std::uint32_t step_;    // one of `step_` lines is sampled
  const std::uint32_t stride_;  // of a row of samples, with what kernels need behind it
  messages::PrivateMemory memory_;
  std::vector<std::uint8_t> all_lines_;
  std::vector<raster::LineLoad> share_loads_;
  std::vector<raster::LineLoad> loads_;  // of all shares
  std::vector<Columns> moving_columns_;
  std::vector<raster::LineLoad> moving_loads_;  // of the edge boxes, moving parts'
  std::vector<SurfaceMark> marked_;             // of a share
  std::vector<wire::SurfaceLine> surface_;      // by line: of the surface in hand
  geometry::LineRange kept_{0, 0};              // lines whose triangles are kept
  bool is_short_ = false;                       // of memory: not all are
  std::vector<geometry::Triangle> triangles_;   // of the sampled lines
  std::vector<SampledLine> sampled_;
  BlockRow constant_row_, moving_row_;
  std::vector<wire::BlockStretch> constant_blocks_, moving_blocks_;  // of the frame
  std::vector<std::uint32_t> ids_;
  std::vector<float> depths_;
  std::optional<ShadowCounter> shadows_;  // where lights cast
};

}  // namespace mars::node
