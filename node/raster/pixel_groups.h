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
#include "node/raster/still_lines.h"
#include "node/raster/strip_buffer.h"
#include "node/shading/kernels.h"

namespace mars::raster {

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
  Light light() { return {light_[0].data(), light_[1].data(), light_[2].data()}; }

  // Of a whole line's groups, how many are on marked columns.
  std::uint32_t count_on(MarkedTiles marked) const;
  // Copies these, or all.
  void copy_to(const StillGroups& still, MarkedTiles marked) const;
  void copy_to(const StillGroups& still) const;

  // Both resolve() and resolve_over() use the groups up.

  // Makes pixels of them and of the background.
  void resolve(const shading::Shading& shading, std::uint32_t line, StripBuffer::Layer& out);
  // And of the line's still groups; also of the pixels in `columns`, ascending, which may have no groups but still
  // ones.
  void resolve_over(const StillGroups& still, const shading::Shading& shading, std::uint32_t line,
                    StripBuffer::Layer& out, std::span<const std::uint32_t> columns = {});

 private:
  template <typename Has>
  void copy_some(const StillGroups& still, const Has& has) const;
  Groups groups() { return {fragments_.data(), masks_.data(), pixels_.data()}; }
  void add_pixels(std::span<const std::uint32_t> columns);
  void move_pixel(std::uint32_t from, std::uint32_t to);
  void put_empty_pixel(std::uint32_t at, std::uint32_t column);
  void add_uncovered(const StillGroups& still, std::uint32_t pixel);
  void put(const shading::Shading& shading, std::uint32_t line, StripBuffer::Layer& out);

  const RasterKernels& kernels_;
  const shading::ShadingKernels& shading_kernels_;
  const color::ColorKernels& color_kernels_;
  std::size_t width_;
  std::uint32_t samples_;
  // As in Groups; once groups are added up, masks and light of pixels.
  std::vector<shading::Fragment> fragments_;
  std::vector<std::uint32_t> masks_;
  std::vector<std::uint32_t> pixels_;
  std::array<std::vector<float>, 3> light_;
  GroupCounts counts_{};
};

}  // namespace mars::raster
