// A terminal as a player's screen: the picture above lines of text.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/preview/screen.h"
#include "host/preview/terminal.h"
#include "host/preview/terminal_picture.h"

namespace mars::preview {

class TerminalScreen : public Screen {
 public:
  // The terminal outlives it.
  explicit TerminalScreen(Terminal& terminal);

  images::PictureSize space() const override;
  void show(const SharedImage& image, const Words& words) override;
  ScreenEvents wait(std::chrono::nanoseconds time) override;

 private:
  std::vector<std::string> notes_of(const Words& words) const;
  void show_picture(SharedImage image, std::size_t notes);
  void write_line(std::size_t above, const std::string& text);
  void forget();

  Terminal& terminal_;
  std::unique_ptr<TerminalPicture> picture_;
  std::vector<std::string> notes_;  // as they stand on the screen
  images::PictureSize extent_{0, 0};
};

}  // namespace mars::preview
