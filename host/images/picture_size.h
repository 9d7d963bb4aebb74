// Width and height of a picture, also as people write them: 960x540.
#pragma once

#include <cstdint>
#include <string>

namespace mars::images {

struct PictureSize {
  std::uint32_t width;  // pixels, 1..wire::kMaxSide
  std::uint32_t height;

  bool operator==(const PictureSize&) const = default;
};

// A picture of square pixels that is shown as one of `size`, whose pixels are each `pixel_aspect` times as wide as
// high; as high as that.
PictureSize with_square_pixels(PictureSize size, double pixel_aspect);

// From "960x540". Throws Failure where that is no size.
PictureSize read_picture_size(const std::string& text);

}  // namespace mars::images
