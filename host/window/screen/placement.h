// Where a picture is in a window, and how large: as large as fits, by a whole factor where that enlarges it, so that
// pixels stay crisp; or one pixel of the window for each pixel of the picture.
#pragma once

#include <cstdint>
#include <span>

#include "host/images/picture_size.h"
#include "host/render/compositor/rectangles.h"

namespace mars::window {

// A part of a window, pixels.
struct Area {
  std::uint32_t x, y, width, height;

  bool empty() const { return width == 0 || height == 0; }
  bool operator==(const Area&) const = default;
};

enum class Zoom { fit, one_to_one };

// How far a person has moved a picture that is larger than the window, pixels.
struct Shift {
  std::int32_t x = 0, y = 0;
};

// One direction of a placement.
class Axis {
 public:
  Axis(std::uint32_t pixels, std::uint32_t shown, std::uint32_t window, std::int32_t shift);

  // The window's pixels [first, last) that show any of the picture's [from, to).
  std::uint32_t first(std::uint32_t from) const;
  std::uint32_t last(std::uint32_t to) const;
  // The picture's pixels [from, to) that a pixel of the window shows.
  std::uint32_t from(std::uint32_t at) const;
  std::uint32_t to(std::uint32_t at) const;

 private:
  std::uint32_t pixels_, shown_, window_;
  std::int64_t begin_;  // in the window; negative: some of the picture is outside of it
};

class Placement {
 public:
  Placement(images::PictureSize picture, images::PictureSize window, Zoom zoom, Shift shift);

  // The part of the window that shows pixels of `rect`.
  Area shown(const compositor::Rect& rect) const;
  // Draws the picture's pixels in an area that shown() returned. A pixel of the window that shows several of the
  // picture is their mean.
  void draw(std::span<const std::uint32_t> picture, const Area& area, std::span<std::uint32_t> window) const;

 private:
  Placement(images::PictureSize picture, images::PictureSize shown, images::PictureSize window, Shift shift);

  images::PictureSize picture_, window_;
  Axis across_, down_;
};

}  // namespace mars::window
