// Frames' pixels as they are shown: red, green and blue of 8 bits each; those with alpha over the film's background.
#pragma once

#include <cstdint>
#include <span>

#include "node/color/encoding.h"
#include "node/wire/film.h"
#include "node/wire/pixel_format.h"

namespace mars::watch {

class Display {
 public:
  // For frames of this format. The film outlives it.
  Display(const wire::PackedFilm& film, wire::PixelFormat format) : film_(film), format_(format) {}
  Display(const wire::PackedFilm&&, auto&&...) = delete;

  // What comes is of this frame. Whether it is shown otherwise than the frame before.
  bool begin_frame(std::uint32_t frame);
  // Words of pixels to as many pixels, whose highest byte is 0.
  void show(std::span<const std::uint32_t> words, std::uint32_t* pixels) const;

 private:
  std::uint32_t shown_light(std::uint64_t pixel) const;

  const wire::PackedFilm& film_;
  const wire::PixelFormat format_;
  color::Encoding encoding_;      // of light, where frames have that
  std::uint32_t background_ = 0;  // where they have alpha
};

}  // namespace mars::watch
