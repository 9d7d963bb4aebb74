// A window with its picture, as those use it who know where pictures come from (rendering_show.h, player_show.h).
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "host/render/pictures/reading.h"
#include "host/window/screen/window.h"

namespace mars::window {

class Screen {
 public:
  // Opens a window if none is open.
  void begin(const std::string& title, images::PictureSize picture);
  // A picture of any size.
  void paste(const pictures::Picture& picture);
  void set_title(const std::string& title);

  // What a person did, but what concerns the window alone.
  std::vector<Event> events();
  Canvas& canvas() { return canvas_; }
  bool is_open() const { return window_.is_open(); }

  // Shows what has changed.
  void update();

 private:
  using Clock = std::chrono::steady_clock;

  void begin_picture(images::PictureSize picture);
  void update_title();

  Window window_;
  Canvas canvas_;
  images::PictureSize picture_{1, 1};
  bool has_picture_ = false;
  std::string title_, shown_title_;
  Clock::time_point titled_;
};

}  // namespace mars::window
