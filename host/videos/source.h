// Pictures that become a video: all of one size, at a constant rate.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/images/image.h"
#include "host/images/picture_place.h"
#include "host/images/picture_size.h"

namespace mars::videos {

using Picture = std::shared_ptr<const images::Image>;  // of 8 bits a channel, as it is shown

struct Source {
  images::PictureSize size{};
  images::Ratio pixel{1, 1};                      // its shape, width to height
  double rate = 24;                               // pictures a second
  std::vector<std::uint32_t> frames{};            // of the film, which it shows in this order
  std::uint32_t film_frames = 0;                  // of the whole film
  double begins = 0;                              // seconds of the film before the first of them
  std::string film{};                             // its file's name; "": it has none
  std::string checksum{};                         // of the compiled film; "": not known
  std::function<Picture(std::size_t)> picture{};  // by its place in `frames`
  bool any_thread = false;                        // picture() may be called by several at once
  // What decides a picture's pixels; none: that is not known, so that no encoded piece can be used again.
  std::function<std::string(std::size_t)> content{};
};

}  // namespace mars::videos
