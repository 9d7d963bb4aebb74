// The layers of a line's pixels (node/wire/pixel_format.h), gathered from the groups of samples that they show, and put
// behind the pixels' colours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/shading/shading.h"
#include "node/wire/pixel_format.h"
#include "node/wire/still_plan.h"

namespace mars::raster {

class LayerPixels {
 public:
  // `pixels` pixels that show nothing yet.
  void begin(wire::PixelFormat format, std::uint32_t pixels);
  // `samples` samples of a pixel are of one group.
  void add(std::uint32_t pixel, std::uint32_t samples, const wire::SurfacePoint& point);
  // For pixels that come in between: as PixelGroups does.
  void grow(std::uint32_t pixels);
  void move(std::uint32_t from, std::uint32_t to);
  void clear(std::uint32_t pixel);

  // Where kernels write the colours of the line's pixels, and those without shadows.
  std::byte* colors() { return colors_.data(); }
  std::byte* unshadowed() { return unshadowed_.data(); }
  // Puts the first `pixels` pixels with all their layers to `out`. `has_unshadowed`: without it the colours are those.
  void write(std::uint32_t pixels, bool has_unshadowed, std::byte* out) const;

 private:
  struct Surface {
    std::uint32_t segment;
    std::uint32_t samples;
  };
  // Sums over samples.
  struct Pixel {
    float depth;
    float normal[3];
    float motion[2];
    std::uint32_t surfaces;  // how many
  };

  Surface* surfaces_of(std::uint32_t pixel) { return &surfaces_[std::size_t{pixel} * samples_]; }
  const Surface* surfaces_of(std::uint32_t pixel) const { return &surfaces_[std::size_t{pixel} * samples_]; }
  void put_surfaces(std::uint32_t pixel, std::uint32_t* words) const;

  wire::PixelFormat format_ = wire::PixelFormat::half;
  std::uint32_t samples_ = 1;
  std::vector<Pixel> pixels_;
  std::vector<Surface> surfaces_;  // as many of each pixel as it has samples
  std::vector<std::byte> colors_, unshadowed_;
};

}  // namespace mars::raster
