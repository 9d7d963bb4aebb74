// The mean of a picture's pixels: what stands for a texture.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace mars::images {

struct PictureMean {
  std::array<double, 3> light;   // 0 to 1; each pixel's sRGB as light, counted by its alpha
  std::array<double, 3> values;  // 0 to 1; of the channels as numbers, whatever the alpha
};

// Of a PNG or JPEG file's bytes; none where they begin as neither. Throws Failure naming the file where it is torn.
std::optional<PictureMean> picture_mean(std::span<const std::byte> bytes, const std::string& name);

}  // namespace mars::images
