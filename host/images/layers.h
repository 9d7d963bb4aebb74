// Layers of EXR files (node/wire/pixel_format.h says what they show): their names for people, the files' channels, and
// the words that a file has of a pixel. These are those of the picture, but that its list of segments becomes shares of
// actors, joints and materials, as the Cryptomatte specification 1.2.0 has them
// (github.com/Psyop/Cryptomatte/blob/master/specification).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/images/picture_format.h"
#include "host/images/surface_names.h"
#include "node/wire/pixel_format.h"

namespace mars::images {

// Of each layer, in their order, as people write it: "depth".
std::string_view name_of(wire::Layer layer);
// "depth,ids"; throws Failure where a name is none, or comes twice. "all": all. "": none.
wire::LayerSet layers_in(std::string_view text);
std::string text_of(wire::LayerSet kinds);

// Of pictures as they are drawn, of `samples` a pixel; how files have them, does not depend on the samples.
wire::PixelFormat pixels_of(PictureFormat format, wire::LayerSet layers, std::uint32_t samples = 0);

// One number of a pixel.
struct LayerChannel {
  std::string name;
  bool is_half;
  std::size_t at;  // bytes from the beginning of the file's pixel
};

// Of a file whose picture has such pixels, the colours' first.
std::vector<LayerChannel> channels_of(wire::PixelFormat pixels);
// Words of a file's pixel.
std::size_t file_words(wire::PixelFormat pixels);
// A picture's pixels as a file has them, of a format with Layer::surfaces; `names`: of its film.
std::vector<std::uint32_t> to_file(wire::PixelFormat format, const SurfaceNames* names,
                                   std::span<const std::uint32_t> pixels);

}  // namespace mars::images
