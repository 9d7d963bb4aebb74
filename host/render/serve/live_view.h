// One view as the host composes it: the saved background of its interval, pictures that are being put together, and
// what the studio gets of each that is whole.
#pragma once

#include <cstdint>
#include <list>
#include <vector>

#include "host/render/compositor/compositor.h"
#include "host/render/farm/strip_message.h"
#include "host/render/pictures/reading.h"

namespace mars::serve {

class LiveView {
 public:
  LiveView(std::uint32_t width, std::uint32_t height, std::uint32_t block);

  bool has_size(std::uint32_t width, std::uint32_t height) const { return width == width_ && height == height_; }

  // A new one, of this plain background. `alone`: all of it moves, and there is no saved background to keep.
  void begin_interval(std::uint64_t plain, bool alone);

  // Of the interval, and undone when another begins. Its keyframe comes first, and is whole before the next begins.
  compositor::Frame* begin_picture();
  void paste(const farm::StripMessage& strip, compositor::Frame& picture);
  // It will not be finished.
  void give_up(compositor::Frame* picture);
  // All strips of it were pasted. Where it differs from the picture before. `number`: of pictures of all views.
  pictures::Picture finish(compositor::Frame* picture, std::uint32_t number);

 private:
  std::uint32_t width_;
  std::uint32_t height_;
  std::uint32_t block_;
  compositor::Compositor compositor_;
  bool alone_ = false;
  std::list<compositor::Frame> frames_;
  std::vector<compositor::Frame*> free_;  // frames to draw into; the one used last is last
};

}  // namespace mars::serve
