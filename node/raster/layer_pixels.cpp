#include "node/raster/layer_pixels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "node/color/encoding.h"
#include "node/simd/vector_slack.h"

namespace mars::raster {

using wire::Layer;

void LayerPixels::begin(wire::PixelFormat format, std::uint32_t pixels) {
  format_ = format;
  samples_ = wire::layered_samples_of(format);
  pixels_.clear();
  grow(pixels);
}

void LayerPixels::grow(std::uint32_t pixels) {
  const std::size_t before = pixels_.size();
  pixels_.resize(pixels);
  surfaces_.resize(std::max(surfaces_.size(), std::size_t{pixels} * samples_));
  const std::size_t bytes = (pixels + simd::kVectorSlack) * wire::color_words(format_) * sizeof(std::uint32_t);
  for (auto* colors : {&colors_, &unshadowed_}) colors->resize(std::max(colors->size(), bytes));
  for (std::size_t pixel = before; pixel < pixels; ++pixel) clear(static_cast<std::uint32_t>(pixel));
}

void LayerPixels::clear(std::uint32_t pixel) { pixels_[pixel] = {wire::kNoDepth, {}, {}, 0}; }

void LayerPixels::move(std::uint32_t from, std::uint32_t to) {
  pixels_[to] = pixels_[from];
  std::copy_n(surfaces_of(from), pixels_[from].surfaces, surfaces_of(to));
}

void LayerPixels::add(std::uint32_t number, std::uint32_t samples, const wire::SurfacePoint& point) {
  if (samples == 0) return;
  Pixel& pixel = pixels_[number];
  const auto weight = static_cast<float>(samples);
  pixel.depth = std::min(pixel.depth, point.depth);
  for (int axis = 0; axis < 3; ++axis) pixel.normal[axis] += weight * point.normal[axis];
  for (int axis = 0; axis < 2; ++axis) pixel.motion[axis] += weight * point.motion[axis];
  Surface* const first = surfaces_of(number);
  Surface* const end = first + pixel.surfaces;
  Surface* const there = std::find_if(first, end, [&](const Surface& s) { return s.segment == point.segment; });
  if (there == end) *there = {point.segment, 0}, ++pixel.surfaces;
  there->samples += samples;
}

// Those with more samples first, of as many the lower segment.
void LayerPixels::put_surfaces(std::uint32_t pixel, std::uint32_t* words) const {
  std::array<Surface, 16> sorted;
  const std::uint32_t count = pixels_[pixel].surfaces;
  std::copy_n(surfaces_of(pixel), count, sorted.begin());
  std::sort(sorted.begin(), sorted.begin() + count, [](const Surface& a, const Surface& b) {
    return a.samples != b.samples ? a.samples > b.samples : a.segment < b.segment;
  });
  for (std::uint32_t k = 0; k < samples_; ++k)
    words[k] = k < count ? wire::surface_word(sorted[k].segment, sorted[k].samples) : 0;
}

void LayerPixels::write(std::uint32_t pixels, bool has_unshadowed, std::byte* out) const {
  constexpr std::size_t kColorWords = 2;
  const std::size_t words = wire::pixel_words(format_), color_bytes = kColorWords * sizeof(std::uint32_t);
  const float share = 1.0f / static_cast<float>(samples_);
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  std::array<std::uint32_t, 32> pixel;
  for (std::uint32_t k = 0; k < pixels; ++k, out += words * sizeof(std::uint32_t)) {
    const Pixel& from = pixels_[k];
    const auto at = [&](Layer layer) { return &pixel[wire::layer_at(format_, layer)]; };
    std::memcpy(pixel.data(), colors_.data() + k * color_bytes, color_bytes);
    if (wire::has_layer(format_, Layer::depth)) *at(Layer::depth) = bits(from.depth);
    if (wire::has_layer(format_, Layer::normal)) {
      const auto half = [&](int axis) { return color::half_of(from.normal[axis] * share); };
      at(Layer::normal)[0] = half(0) | half(1) << 16;
      at(Layer::normal)[1] = half(2);
    }
    if (wire::has_layer(format_, Layer::unshadowed)) {
      const auto& light = has_unshadowed ? unshadowed_ : colors_;
      std::memcpy(at(Layer::unshadowed), light.data() + k * color_bytes, color_bytes);
      at(Layer::unshadowed)[1] &= 0xffff;
    }
    if (wire::has_layer(format_, Layer::motion))
      for (int axis = 0; axis < 2; ++axis) at(Layer::motion)[axis] = bits(from.motion[axis] * share);
    if (wire::has_layer(format_, Layer::surfaces)) put_surfaces(k, at(Layer::surfaces));
    std::memcpy(out, pixel.data(), words * sizeof(std::uint32_t));
  }
}

}  // namespace mars::raster
