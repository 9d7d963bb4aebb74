// Pictures as a terminal takes them, each kind of terminal in a file of its own. What stands on the screen is known
// from one picture to the next.
#pragma once

#include <memory>
#include <string>

#include "host/preview/pictures.h"
#include "host/preview/terminal.h"

namespace mars::preview {

class TerminalPicture {
 public:
  virtual ~TerminalPicture() = default;

  // The terminal's space for pictures, without `lines` lines of text beneath, in pixels.
  virtual images::PictureSize space(const Terminal& terminal, std::uint32_t lines) const = 0;
  // What shows `image` in the upper left corner, where the last one stood.
  virtual const std::string& shown(const images::Image& image) = 0;
  // The screen is empty again.
  virtual void forget() {}
};

// Two pixels a character, one above the other; only characters that changed are sent.
std::unique_ptr<TerminalPicture> make_blocks(bool colors24);
// PNG files by kitty's protocol, each under another number than the one it replaces, so that nothing blinks.
std::unique_ptr<TerminalPicture> make_kitty();
// DEC's six-pixel rows, in the 255 colours the picture has most of.
std::unique_ptr<TerminalPicture> make_sixel();

std::unique_ptr<TerminalPicture> make_terminal_picture(Graphics graphics);

}  // namespace mars::preview
