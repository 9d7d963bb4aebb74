// The terminal a person sits at: taken over while this lives, and given back as it was however it ends (an error, a
// signal, a suspension). Signals that end, stop or resize us come in as events, so nothing happens behind anyone's
// back.
#pragma once

#include <signal.h>
#include <termios.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "host/preview/key_press.h"
#include "host/preview/pictures.h"

namespace mars::preview {

// How pictures are shown, best first: the terminal's own graphics, or two pixels a character in colours.
enum class Graphics { automatic, kitty, sixel, blocks, blocks256 };

struct TerminalEvents {
  std::vector<KeyPress> keys;
  bool redraw = false;  // resized, or back from a suspension: the screen is empty
  int ended_by = 0;     // the signal that asked for the end
};

class Terminal {
 public:
  // Throws Failure where standard input or output is no terminal, or one that cannot place text. `colors24`: what the
  // environment says of its colours.
  Terminal(Graphics wanted, const std::string& kind, bool colors24);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  Graphics graphics() const { return graphics_; }
  images::PictureSize cells() const { return cells_; }
  images::PictureSize cell() const { return cell_; }  // pixels of one, where graphics have pixels
  // Waits while the terminal takes nothing, but for no longer than until a signal asks for the end; what is left is
  // then dropped.
  void write(std::string_view bytes);

  // What happens within `time`; returns as soon as something does.
  TerminalEvents wait(std::chrono::nanoseconds time);

 private:
  void block_signals();
  void read_signals();
  void handle_signals();
  void ask(bool colors24);
  void set_modes(const termios& modes);
  void enter();
  void leave();
  void suspend();
  void measure();
  bool write_some(std::string_view& bytes);
  void write_within(std::string_view bytes, std::chrono::milliseconds time);
  void read_keys();
  std::string answers(std::string_view questions);

  Graphics graphics_;
  images::PictureSize cells_{80, 24};
  images::PictureSize cell_{10, 20};
  termios before_{};
  sigset_t signals_before_{};
  int signals_ = -1;  // a signalfd
  int output_ = -1;   // standard output's terminal, never waited for by the system
  bool entered_ = false;
  bool stop_ = false, continued_ = false, resized_ = false;  // what signals ask for, until it is handled
  int ended_by_ = 0;                                         // as in TerminalEvents; nothing is played any more
  std::string unread_;                                       // of a key that is not complete
  std::chrono::steady_clock::time_point read_at_;            // when the last of it came
};

}  // namespace mars::preview
