// Shading once for several samples: the samples of a pixel that show the same triangle are a group, which is shaded
// once, at its sample nearest to the pixel's centre (SamplePattern). Still samples are grouped among still samples
// alone, the moving ones that are seen among themselves. A pixel is the sum of its groups' light by their numbers of
// samples: moving groups in the order of their samples, then still ones for the samples that no moving one covers, then
// the background.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "node/color/kernels.h"
#include "node/raster/kernels.h"
#include "node/raster/layer_pixels.h"
#include "node/raster/still_lines.h"
#include "node/raster/strip_buffer.h"
#include "node/shading/kernels.h"

namespace mars::raster {

// What layers show of a group of line `line`.
wire::SurfacePoint point_of(const shading::Shading& shading, const shading::Fragment& group, std::uint32_t line);

// The groups of one line and one kind.
class PixelGroups {
 public:
  PixelGroups(simd::InstructionSet set, std::size_t width, std::uint32_t samples);

  // Groups and shades what is seen on columns `extent` of line `line`; says how many groups.
  shading::ShadedCounts shade(const shading::Shading& shading, const LineSamples& seen, std::uint32_t line,
                              const shading::Extent& extent);
  std::uint32_t count() const { return counts_.pixels + counts_.others; }

  // In pictures with shadows: groups alone; copied out, and back with light that was summed up elsewhere.
  void group(const shading::Shading& shading, const LineSamples& seen, const shading::Extent& extent);
  const GroupCounts& counts() const { return counts_; }
  void copy_to(const Groups& out) const;
  void restore(const GroupCounts& counts, const Groups& from);
  Light light() { return light_of(light_); }
  // In pictures with layers of films with shadows: as light(), if nothing blocked any.
  Light unshadowed();

  // Of a whole line's groups, how many are on marked columns.
  std::uint32_t count_on(MarkedTiles marked) const;
  // Copies these, or all.
  void copy_to(const StillGroups& still, const shading::Shading& shading, std::uint32_t line, MarkedTiles marked) const;
  void copy_to(const StillGroups& still, const shading::Shading& shading, std::uint32_t line) const;

  // Both resolve() and resolve_over() use the groups up.

  // Makes pixels of them and of the background; they show no motion, for what stands still goes out here.
  void resolve(const shading::Shading& shading, std::uint32_t line, StripBuffer::Layer& out);
  // And of the line's still groups; also of the pixels in `columns`, ascending, which may have no groups but still
  // ones.
  void resolve_over(const StillGroups& still, const shading::Shading& shading, std::uint32_t line,
                    StripBuffer::Layer& out, std::span<const std::uint32_t> columns = {});

 private:
  using Channels = std::array<std::vector<float>, 3>;

  static Light light_of(Channels& channels) { return {channels[0].data(), channels[1].data(), channels[2].data()}; }
  template <typename Has>
  void copy_some(const StillGroups& still, const shading::Shading& shading, std::uint32_t line, const Has& has) const;
  void add_up(const shading::Shading& shading, std::uint32_t line, bool with_motion);
  void gather_layers(const shading::Shading& shading, std::uint32_t line, bool with_motion);
  Groups groups() { return {fragments_.data(), masks_.data(), pixels_.data()}; }
  void add_pixels(std::span<const std::uint32_t> columns);
  void move_pixel(std::uint32_t from, std::uint32_t to);
  void put_empty_pixel(std::uint32_t at, std::uint32_t column);
  void add_uncovered(const StillGroups& still, std::uint32_t pixel);
  void put(const shading::Shading& shading, std::uint32_t line, StripBuffer::Layer& out);
  void encode(const shading::Shading& shading, Channels& channels, std::byte* to);

  const RasterKernels& kernels_;
  const shading::ShadingKernels& shading_kernels_;
  const color::ColorKernels& color_kernels_;
  std::size_t width_;
  std::uint32_t samples_;
  // As in Groups; once groups are added up, masks and light of pixels.
  std::vector<shading::Fragment> fragments_;
  std::vector<std::uint32_t> masks_;
  std::vector<std::uint32_t> pixels_;
  Channels light_;
  GroupCounts counts_{};
  // Of pictures with layers.
  LayerPixels layers_;
  bool has_layers_ = false;                // of the groups in hand
  Channels unshadowed_;                    // empty where it is light_
  std::vector<std::uint32_t> kept_masks_;  // while unshadowed_ is summed
};

}  // namespace mars::raster
