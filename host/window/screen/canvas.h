// The pixels of a window: a picture at its place (placement.h), and on demand the outlines of what came last. It knows
// which parts of the window are no more what was taken before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/window/screen/placement.h"

namespace mars::window {

class Canvas {
 public:
  // Another picture, black so far.
  void begin(images::PictureSize picture);
  // Another size of the window.
  void resize(images::PictureSize window);
  void zoom(Zoom zoom);
  void move(Shift by);
  // Whether rectangles that come are outlined, until others come.
  void outline(bool flags);
  bool outlines() const { return outline_; }

  // New pixels of the picture, those of rectangle after rectangle.
  void paste(std::span<const compositor::Rect> rects, std::span<const std::uint32_t> pixels);

  // What has changed in the window since the last call.
  std::vector<Area> take_changed();

  images::PictureSize size() const { return window_; }
  // Rows of the window from the top: red in the lowest byte, then green and blue.
  std::vector<std::uint32_t>& pixels() { return pixels_; }

 private:
  void draw_all();
  void draw_outlines();
  void frame(const Area& area);

  images::PictureSize picture_{1, 1}, window_{1, 1};
  Zoom zoom_ = Zoom::fit;
  Shift shift_;
  bool outline_ = false;
  bool all_ = true;                                                   // has changed
  std::vector<std::uint32_t> whole_ = std::vector<std::uint32_t>(1);  // picture
  std::vector<std::uint32_t> pixels_ = std::vector<std::uint32_t>(1);
  std::vector<compositor::Rect> came_;      // since the last call
  std::vector<compositor::Rect> outlined_;  // in the window
};

}  // namespace mars::window
