#include "host/preview/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mars::preview {

images::PictureSize fitted(images::PictureSize film, images::PictureSize space) {
  const double scale = std::min(double(space.width) / film.width, double(space.height) / film.height);
  const auto side = [&](std::uint32_t length, std::uint32_t most) {
    return std::clamp(static_cast<std::uint32_t>(std::lround(scale * length)), 1u, std::max(most, 1u));
  };
  return {side(film.width, space.width), side(film.height, space.height)};
}

images::Image scaled(const images::Image& image, images::PictureSize extent) {
  if (images::PictureSize{image.width, image.height} == extent) return image;
  images::Image out{extent.width, extent.height, {}};
  out.pixels.reserve(std::size_t{out.width} * out.height);
  // Of each new column or row, the first old one under it and the one behind its last.
  const auto under = [](std::uint32_t at, std::uint32_t from, std::uint32_t to) {
    const auto first = static_cast<std::uint32_t>(std::uint64_t{at} * from / to);
    const auto end = static_cast<std::uint32_t>((std::uint64_t{at} + 1) * from / to);
    return std::array{first, std::max(end, first + 1)};
  };
  for (std::uint32_t y = 0; y < out.height; ++y) {
    const auto rows = under(y, image.height, out.height);
    for (std::uint32_t x = 0; x < out.width; ++x) {
      const auto columns = under(x, image.width, out.width);
      std::uint64_t red = 0, green = 0, blue = 0;
      for (std::uint32_t row = rows[0]; row < rows[1]; ++row)
        for (std::uint32_t column = columns[0]; column < columns[1]; ++column) {
          const std::uint32_t pixel = image.pixels[std::size_t{row} * image.width + column];
          red += pixel & 0xff;
          green += pixel >> 8 & 0xff;
          blue += pixel >> 16 & 0xff;
        }
      const std::uint64_t count = std::uint64_t{rows[1] - rows[0]} * (columns[1] - columns[0]);
      out.pixels.push_back(static_cast<std::uint32_t>(red / count | green / count << 8 | blue / count << 16));
    }
  }
  return out;
}

}  // namespace mars::preview
