// Where a player shows pictures: a terminal or a window.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "host/preview/key_press.h"
#include "host/preview/pictures.h"

namespace mars::preview {

// What stands beside a picture; "": nothing.
struct Words {
  std::string keys;     // what keys do, in lines
  std::string note;     // what a person does just now
  std::string trouble;  // why pictures are not renewed
  std::string status;   // one line

  bool operator==(const Words&) const = default;
};

struct ScreenEvents {
  std::vector<KeyPress> keys;
  bool redraw = false;  // what was shown is gone, or there is another space now
  int ended_by = 0;     // the signal that asked for the end
  bool closed = false;  // by a person
};

class Screen {
 public:
  virtual ~Screen() = default;

  // What a picture may have, pixels.
  virtual images::PictureSize space() const = 0;
  // False: it takes nothing now, and wait() returns when it does.
  virtual bool is_ready() const { return true; }
  // nullptr: the picture stays.
  virtual void show(const SharedImage& image, const Words& words) = 0;
  // What happens within `time`; returns as soon as something does.
  virtual ScreenEvents wait(std::chrono::nanoseconds time) = 0;
};

}  // namespace mars::preview
