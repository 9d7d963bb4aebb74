// The film whose frames are small pictures of the library's models: one after the other, each seen whole.
#pragma once

#include <string>
#include <vector>

namespace mars::studio {

inline constexpr unsigned kThumbnailSize = 128;  // pixels a side

struct ThumbnailFilm {
  std::vector<std::string> names;  // of the models, by frame
  std::string text;                // of the film's file
};

// Takes some tenths of a second.
ThumbnailFilm thumbnail_film();

}  // namespace mars::studio
