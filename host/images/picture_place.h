// Where the pixels of a frame's file lie in the film's picture, and which shape pixels have.
#pragma once

#include "node/wire/film_parts.h"

namespace mars::images {

struct PicturePlace {
  wire::PictureWindow window{};  // whole: the file has all of the picture
  float pixel_aspect = 1;        // width of a pixel by its height

  bool operator==(const PicturePlace&) const = default;
};

inline PicturePlace place_of(const wire::FilmSettings& settings) { return {settings.window, settings.pixel_aspect}; }

// The same number as two small whole ones, width to height: 2 is 2:1, 1.4583334 is 35:24.
struct Ratio {
  std::uint32_t width;
  std::uint32_t height;
};
Ratio ratio_of(float pixel_aspect);

}  // namespace mars::images
