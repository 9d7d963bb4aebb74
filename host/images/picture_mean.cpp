#include "host/images/picture_mean.h"

#include <algorithm>

#include "host/content/document/shown_color.h"
#include "host/images/jpeg_file.h"
#include "host/images/png_file.h"

namespace mars::images {
namespace {

constexpr std::uint32_t kOpaque = 0xff000000;

bool begins_with(std::span<const std::byte> bytes, std::initializer_list<int> start) {
  const auto same = [](std::byte byte, int value) { return std::to_integer<int>(byte) == value; };
  return bytes.size() >= start.size() &&
         std::equal(bytes.begin(), bytes.begin() + std::ptrdiff_t(start.size()), start.begin(), same);
}

// Alpha is in the highest byte.
std::optional<Image> decoded(std::span<const std::byte> bytes, const std::string& name) {
  if (begins_with(bytes, {0x89, 'P', 'N', 'G'})) return decode_png_with_alpha(bytes, name);
  if (!begins_with(bytes, {0xff, 0xd8, 0xff})) return std::nullopt;
  Image image = decode_jpeg(bytes, name);
  for (std::uint32_t& pixel : image.pixels) pixel |= kOpaque;
  return image;
}

std::array<double, 256> light_of_levels() {
  std::array<double, 256> lights{};
  for (std::size_t level = 0; level < lights.size(); ++level)
    lights[level] = document::light_of_shown(static_cast<double>(level) / 255);
  return lights;
}

}  // namespace

std::optional<PictureMean> picture_mean(std::span<const std::byte> bytes, const std::string& name) {
  const std::optional<Image> image = decoded(bytes, name);
  if (!image) return std::nullopt;
  static const std::array<double, 256> kLight = light_of_levels();
  // Of a picture that cannot be seen at all, all pixels count the same.
  const bool hidden = std::ranges::none_of(image->pixels, [](std::uint32_t pixel) { return pixel & kOpaque; });
  PictureMean sum{};
  double weights = 0;
  for (const std::uint32_t pixel : image->pixels) {
    const double weight = hidden ? 255 : pixel >> 24;
    weights += weight;
    for (unsigned channel = 0; channel < 3; ++channel) {
      const std::uint32_t level = pixel >> 8 * channel & 255;
      sum.light[channel] += weight * kLight[level];
      sum.values[channel] += level;
    }
  }
  const auto pixels = static_cast<double>(image->pixels.size());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    sum.light[channel] /= weights;
    sum.values[channel] /= 255 * pixels;
  }
  return sum;
}

}  // namespace mars::images
