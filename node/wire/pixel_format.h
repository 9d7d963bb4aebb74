// How the pixels of a strip are stored. Kernels of several instruction sets share it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mars::wire {

// Red, then green, blue and a zero, 8 or 16 bits each. rgb8 and rgb16 are encoded (node/color); half: light before
// exposure and curve, as IEEE 754 half floats. The others have alpha in place of the zero: the share of a pixel's
// samples that surfaces cover. Their background is 0; rgba8 and rgba16 have the colour of what is covered, half_alpha
// its light times alpha.
//
// Half floats may have layers behind them: with_layers() makes such a format, which is none of those named here.
enum class PixelFormat : std::uint32_t { rgb8, rgb16, half, rgba8, rgba16, half_alpha };

// Layers lie behind the colours in this order, each where there is any:
// - depth: a float, the distance along the view axis of the nearest group of samples; kNoDepth where there is none.
// - normal: three halves and a zero, the mean over all samples of unit normals in the world; 0 where nothing is seen.
// - unshadowed: as the colours without alpha, what they would be if no light were blocked.
// - motion: two floats, the mean over all samples of where their points were in the frame before, seen from where they
//   are now, in pixels to the right and up; 0 in a film's first frame.
// - surfaces: a word for each sample, which segments are seen and by how many samples (surface_word), those with more
//   samples first, of as many the lower segment; then zeros.
enum class Layer : std::uint32_t { depth, normal, unshadowed, motion, surfaces };
inline constexpr std::uint32_t kLayers = 5;

inline constexpr float kNoDepth = 1e10f;

// A set of layers: one bit each.
using LayerSet = std::uint32_t;
constexpr LayerSet set_of(Layer layer) { return LayerSet{1} << static_cast<std::uint32_t>(layer); }
inline constexpr LayerSet kAllLayers = (LayerSet{1} << kLayers) - 1;

namespace detail {
inline constexpr std::uint32_t kLayerShift = 8, kSampleShift = 16;
constexpr std::uint32_t bits_of(PixelFormat format) { return static_cast<std::uint32_t>(format); }
}  // namespace detail

// Of pictures of `samples` a pixel.
constexpr PixelFormat with_layers(PixelFormat format, LayerSet layers, std::uint32_t samples) {
  if (layers == 0) return format;
  return static_cast<PixelFormat>(detail::bits_of(format) | layers << detail::kLayerShift |
                                  samples << detail::kSampleShift);
}
constexpr LayerSet layers_of(PixelFormat format) { return detail::bits_of(format) >> detail::kLayerShift & 0xff; }
constexpr std::uint32_t layered_samples_of(PixelFormat format) {
  return detail::bits_of(format) >> detail::kSampleShift;
}
constexpr PixelFormat without_layers(PixelFormat format) {
  return static_cast<PixelFormat>(detail::bits_of(format) & 0xff);
}

constexpr bool has_alpha(PixelFormat format) { return without_layers(format) >= PixelFormat::rgba8; }
// The same without alpha and layers.
constexpr PixelFormat colors_of(PixelFormat format) {
  const auto kWithAlpha = detail::bits_of(PixelFormat::rgba8);
  const PixelFormat bare = without_layers(format);
  return has_alpha(format) ? static_cast<PixelFormat>(detail::bits_of(bare) - kWithAlpha) : bare;
}

// Pictures are arrays of words of 32 bits; colours have one or two, the lower first.
constexpr std::size_t color_words(PixelFormat format) { return colors_of(format) == PixelFormat::rgb8 ? 1 : 2; }
constexpr std::size_t layer_words(Layer layer, std::uint32_t samples) {
  if (layer == Layer::surfaces) return samples;
  return layer == Layer::depth ? 1 : 2;
}
// Where in a pixel the words of one of its layers begin.
constexpr std::size_t layer_at(PixelFormat format, Layer layer) {
  std::size_t at = color_words(format);
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(layer); ++k)
    if ((layers_of(format) & LayerSet{1} << k) != 0)
      at += layer_words(static_cast<Layer>(k), layered_samples_of(format));
  return at;
}
constexpr std::size_t pixel_words(PixelFormat format) { return layer_at(format, static_cast<Layer>(kLayers)); }
constexpr std::size_t pixel_bytes(PixelFormat format) { return pixel_words(format) * sizeof(std::uint32_t); }

constexpr bool has_layer(PixelFormat format, Layer layer) { return (layers_of(format) & set_of(layer)) != 0; }

// A segment of the film, 0 and on, that `samples` of a pixel's samples show.
constexpr std::uint32_t surface_word(std::uint32_t segment, std::uint32_t samples) {
  return (segment + 1) << 5 | samples;
}
constexpr std::uint32_t segment_of(std::uint32_t surface_word) { return (surface_word >> 5) - 1; }
constexpr std::uint32_t samples_of(std::uint32_t surface_word) { return surface_word & 31; }
inline constexpr std::uint32_t kMostSurfaceSegments = (std::uint32_t{1} << 27) - 1;

// Whether it is a format that pictures of `samples` a pixel may have.
constexpr bool is_pixel_format(PixelFormat format, std::uint32_t samples) {
  const LayerSet layers = layers_of(format);
  if (without_layers(format) > PixelFormat::half_alpha || layers > kAllLayers) return false;
  if (layers == 0) return layered_samples_of(format) == 0;
  return colors_of(format) == PixelFormat::half && layered_samples_of(format) == samples;
}

}  // namespace mars::wire
