// What a page gets of one of its views.
#pragma once

#include <cstdint>
#include <vector>

#include "host/render/pictures/reading.h"
#include "host/studio/project/project.h"

namespace mars::studio {

using PageNumber = std::uint32_t;

// For a page, of one of its views: rectangles that changed since its picture before.
struct ViewPicture {
  PageNumber page = 0;
  std::uint32_t view = 0;     // the page's number for it
  std::uint32_t picture = 0;  // 1, 2, ... of this view, without gaps
  std::uint64_t edit = 0;     // the last of the page's messages that it shows
  std::uint16_t width = 0, height = 0;
  bool rests = true;  // false: more changes are to be expected at once (a hand moves); it may be lossy then
  bool exact = true;  // the film's own pixels; false: lines, other eyes, what moves
  std::vector<pictures::Rect> rects;
  std::vector<std::uint32_t> pixels;  // as SurfacePicture's
  Json handles;                       // of the view, to be shown with it (docs/studio-protocol.md)
};

}  // namespace mars::studio
