#include "host/render/panorama/join.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/film/panorama.h"
#include "host/images/half_light.h"
#include "node/wire/pixel_format.h"

namespace mars::panorama {
namespace {

Light between(const Light& a, const Light& b, float part) {
  Light light;
  for (std::size_t c = 0; c < light.size(); ++c) light[c] = a[c] + (b[c] - a[c]) * part;
  return light;
}

std::uint64_t nearest(float value) { return static_cast<std::uint64_t>(value + 0.5f); }

}  // namespace

Face::Face(const images::Image& picture) : side_(picture.width), pixels_(std::size_t{picture.width} * picture.height) {
  check(picture.width == picture.height && picture.pixels.size() == 2 * pixels_.size(), "a face is a square of light");
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const std::uint32_t low = picture.pixels[2 * i], high = picture.pixels[2 * i + 1];
    const auto light = [](std::uint32_t half) { return images::light_of_half(half & 0xffff); };
    pixels_[i] = {light(low), light(low >> 16), light(high), light(high >> 16)};
  }
}

Light Face::at(float column, float row) const {
  const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
  const float right = column - static_cast<float>(x), down = row - static_cast<float>(y);
  const Light* above = &pixels_[y * side_ + x];
  const Light* below = above + side_;
  return between(between(above[0], above[1], right), between(below[0], below[1], right), down);
}

Joiner::Joiner(std::uint32_t width)
    : width_(width), face_pixels_(static_cast<float>(film::face_pixels(width))), directions_(kAcross * width) {}

Light Joiner::light_at(std::span<const Face> faces, std::uint32_t x, std::uint32_t y) const {
  Light sum{};
  for (std::uint32_t down = 0; down < kAcross; ++down) {
    for (std::uint32_t across = 0; across < kAcross; ++across) {
      const Direction direction = directions_.at(std::size_t{kAcross} * x + across, std::size_t{kAcross} * y + down);
      const FacePlace place = place_of(direction, face_pixels_);
      const Light light = faces[place.face].at(place.column, place.row);
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += light[c];
    }
  }
  for (float& channel : sum) channel *= 1.0f / (kAcross * kAcross);
  return sum;
}

void Joiner::join(std::span<const Face> faces, const color::Encoding& encoding, std::span<std::uint32_t> words) const {
  const std::size_t pixel_words = wire::pixel_words(encoding.format);
  check(words.size() == std::size_t{width()} * height() * pixel_words, "a picture has all its words");
  auto word = words.begin();
  for (std::uint32_t y = 0; y < height(); ++y) {
    for (std::uint32_t x = 0; x < width(); ++x) {
      const std::uint64_t pixel = pixel_of(encoding, light_at(faces, x, y));
      *word++ = static_cast<std::uint32_t>(pixel);
      if (pixel_words == 2) *word++ = static_cast<std::uint32_t>(pixel >> 32);
    }
  }
}

std::uint64_t pixel_of(const color::Encoding& encoding, const Light& light) {
  if (!encoding.alpha) return color::pixel_of(encoding, light.data());
  const float alpha = std::min(light[3], 1.0f);
  if (alpha <= 0) return 0;
  if (encoding.format == wire::PixelFormat::half) {
    const float alphas[] = {alpha, 0, 0};
    return color::pixel_of(encoding, light.data()) | color::pixel_of(encoding, alphas) << 48;
  }
  const float straight[] = {light[0] / alpha, light[1] / alpha, light[2] / alpha};
  const std::uint64_t colors = color::pixel_of(encoding, straight);
  return encoding.format == wire::PixelFormat::rgb8 ? colors | nearest(alpha * 255) << 24
                                                    : colors | nearest(alpha * 65535) << 48;
}

}  // namespace mars::panorama
