// A part of a film's picture, also as people write it: 480,270,960x540.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "node/wire/film_parts.h"

namespace mars::film {

// Pixels of the whole picture, from its left top corner.
struct Crop {
  std::uint32_t left;
  std::uint32_t top;
  std::uint32_t width;  // 1..wire::kMaxSide
  std::uint32_t height;

  bool operator==(const Crop&) const = default;
};

// From "480,270,960x540". Throws Failure where that is no part of a picture.
Crop read_crop(const std::string& text);
std::string text_of(const Crop& crop);

// Of settings of a whole picture: only the crop of it is drawn, none: all of it, and `margin` pixels around that.
// Throws Failure naming `source` where the crop leaves the picture, or the margin is wider than the picture's longer
// side or makes a side longer than wire::kMaxSide.
void set_window(const std::optional<Crop>& crop, std::uint32_t margin, const std::string& source,
                wire::FilmSettings& settings);

// What is drawn: "960x540", "480x270 from 100,50 of 960x540".
std::string size_text(const wire::FilmSettings& settings);

}  // namespace mars::film
