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

// From "960x540". Throws Failure where that is no size.
PictureSize read_picture_size(const std::string& text);

}  // namespace mars::images
