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
#include "node/raster/z_line.h"
#include "node/shading/kernels.h"

namespace mars::raster {

// What was done since it was asked last.
struct DrawnCounts {
  std::uint64_t lines = 0;
  std::uint64_t drawn_again = 0;  // lines of an inbetween whose stationary parts were not kept
  std::uint64_t still_bytes = 0;
  shading::ShadedCounts shaded{};
};

class ZBuffer {
 public:
  // `nothing`: as in shape::Projection.
  ZBuffer(simd::InstructionSet set, std::uint32_t width, const shape::SamplePattern& pattern, float nothing = 0);

  // Draws `lines`: what stands still (CFB), and against it what moves (MFB). Lines of `still` are written to it.
  void draw_keyframe(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                     StillLines& still, StripBuffer& out);
  // Draws what moves on these lines against `still` and each other. On lines that it does not keep the parts have what
  // stands still too, which is drawn again.
  void draw_inbetween(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                      StillLines& still, StripBuffer& out);

  DrawnCounts take_counts() { return std::exchange(counts_, {}); }

 private:
  std::uint32_t samples_a_pixel() const { return z_line_.samples_a_pixel(); }
  bool several() const { return samples_a_pixel() > 1; }
  void draw_line(LineParts parts, const shading::Shading& shading, std::uint32_t line, StillLines& still,
                 StripBuffer& out);
  shading::Extent draw_still_again(LineParts parts, const shading::Shading& shading, std::uint32_t line);
  // Over what stands still, which goes out again on the columns `again`, with its motion. Says which columns the boxes
  // span, as does draw.
  shading::Extent draw_moving(LineParts parts, const shading::Shading& shading, std::uint32_t line,
                              const StillGroups& still, const shading::Extent& again, StripBuffer& out);

  // Keeps a line's depths and has its groups kept, if they are needed and fit; says where the groups are to go.
  StillGroups keep(std::uint32_t line, StillLines& still, const shading::Shading& shading);
  StillGroups own_still(const shading::Shading& shading);
  // Of groups that are shaded: those that are kept, and those that this line needs. The latter.
  StillGroups copy_still(std::uint32_t line, StillLines& still, const StillGroups& kept,
                         const shading::Shading& shading, bool needed);
  void take_depths(std::uint32_t line, const shading::Extent& extent, StillLines& still);
  void shade_groups(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent);
  void put_samples(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent,
                   StripBuffer::Layer& out, bool with_motion);
  void put_layers(const shading::Shading& shading, const shading::Shaded& shaded, StripBuffer::Layer& out,
                  bool with_motion);
  void keep_ids(const shading::Extent& extent);
  void show_kept_ids(const shading::Extent& extent);

  const shading::ShadingKernels& shading_kernels_;
  ZLine z_line_;
  PixelGroups groups_;  // of the kind that is being drawn
  // The line's still groups, where inbetweens do not need them or they are not kept.
  std::vector<std::uint32_t> still_end_;
  std::vector<StillGroup> still_groups_;
  // Of pictures with layers.
  std::vector<SurfacePoint> still_surfaces_;
  std::vector<std::uint32_t> again_;      // columns
  std::vector<std::uint32_t> still_ids_;  // with one sample a pixel
  LayerPixels layers_;                    // with one sample a pixel
  DrawnCounts counts_;
};

}  // namespace mars::raster
