// An equirectangular picture, joined of six faces. Each of its pixels is the mean of the light in kAcross x kAcross
// directions evenly over it, each of which is interpolated between the four pixels of its face around it: light before
// exposure and curve, as the samples of a pixel are averaged. Sums have one order, so that a picture has the same bits
// on all machines.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/images/image.h"
#include "host/render/panorama/face_map.h"
#include "node/color/encoding.h"

namespace mars::panorama {

// The corner of a face has three times the pixels for an angle that its middle has.
inline constexpr std::uint32_t kAcross = 3;

// Red, green, blue and alpha, which multiplies them.
using Light = std::array<float, 4>;

// A face's pixels, rows from the top.
class Face {
 public:
  // Of half floats, two words a pixel, a square.
  explicit Face(const images::Image& picture);

  // Bilinear. `column` and `row` from 0 to less than the last pixel's.
  Light at(float column, float row) const;

 private:
  std::size_t side_;
  std::vector<Light> pixels_;
};

class Joiner {
 public:
  // Of panorama pictures of this width.
  explicit Joiner(std::uint32_t width);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return width_ / 2; }
  // The faces' side: face_side().
  Light light_at(std::span<const Face> faces, std::uint32_t x, std::uint32_t y) const;
  // The whole picture, in words of the encoding's pixels.
  void join(std::span<const Face> faces, const color::Encoding& encoding, std::span<std::uint32_t> words) const;

 private:
  std::uint32_t width_;
  float face_pixels_;
  DirectionGrid directions_;
};

// The pixel of light that alpha multiplies, in its lowest bytes; alpha counts where the encoding has some.
std::uint64_t pixel_of(const color::Encoding& encoding, const Light& light);

}  // namespace mars::panorama
