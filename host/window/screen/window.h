// A window on the display: the only code that uses SDL. Of what a window shows, only areas that changed go to the
// display, so that a display at the other end of a network receives few bytes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "host/render/pictures/messages.h"
#include "host/window/screen/canvas.h"

struct SDL_Window;

namespace mars::window {

struct Closed {};   // by a person, or the display asks for it
struct Exposed {};  // the display has lost what the window showed
struct Dragged {
  Shift by;
};
using Event = std::variant<Closed, Exposed, Dragged, pictures::Key>;

class Window {
 public:
  // Reaches the display. Throws Failure if there is none.
  Window();
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // As large as the picture, if the screen has room for it. Throws Failure if the display refuses.
  void open(const std::string& title, images::PictureSize picture);
  bool is_open() const { return window_ != nullptr; }
  void set_title(const std::string& title);

  // None: nothing has happened.
  std::vector<Event> events();
  // Of an open window, pixels.
  images::PictureSize size() const;
  // Shows these areas of a canvas that is as large as the window.
  void show(Canvas& canvas, std::span<const Area> areas);

 private:
  struct Destroy {
    void operator()(SDL_Window* window) const;
  };
  std::unique_ptr<SDL_Window, Destroy> window_;
};

}  // namespace mars::window
