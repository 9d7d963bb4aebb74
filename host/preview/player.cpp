#include "host/preview/player.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "host/preview/terminal_picture.h"

namespace mars::host {
namespace {

using Clock = std::chrono::steady_clock;

constexpr PictureSize kLargest{1280, 720};  // pixels, of terminals that have many
constexpr std::string_view kOwnKeys = " space pause  , . step  home end  [ ] speed  l loop  h help  q quit";

class Player {
 public:
  Player(Pictures& pictures, Terminal& terminal)
      : pictures_(pictures), terminal_(terminal), picture_(make_terminal_picture(terminal.graphics())) {}

  int play() {
    go_on_from(0);
    while (true) {
      show();
      const TerminalEvents events = terminal_.wait(until_next());
      if (events.ended_by != 0) return events.ended_by;
      if (events.redraw) empty();
      for (const KeyPress& key : events.keys)
        if (!obey(key)) return 0;
    }
  }

 private:
  // The frame that is due, as a number with a part.
  double due() const {
    if (paused_) return at_;
    const double passed = std::chrono::duration<double>(Clock::now() - start_).count() * pictures_.rate() * speed_;
    const double position = at_ + passed, frames = pictures_.frames();
    return loop_ ? std::fmod(position, frames) : std::min(position, frames - 1);
  }

  std::uint32_t frame() const { return std::min(static_cast<std::uint32_t>(due()), pictures_.frames() - 1); }

  void go_on_from(double at) {
    at_ = at;
    start_ = Clock::now();
  }

  // While nothing moves, pictures that are being rendered may still come.
  std::chrono::nanoseconds until_next() const {
    const double seconds = (std::floor(due()) + 1 - due()) / (pictures_.rate() * speed_);
    const double at_most = missing_ ? 0.05 : 0.5;
    return std::chrono::nanoseconds(static_cast<std::int64_t>(std::clamp(paused_ ? 1.0 : seconds, 0.0, at_most) * 1e9));
  }

  void show() {
    const std::uint32_t now = frame();
    if (shown_ && now == shown_frame_ && !missing_) return;
    PictureSize room = picture_->room(terminal_, 1 + static_cast<std::uint32_t>(help().size()));
    room = {std::min(room.width, kLargest.width), std::min(room.height, kLargest.height)};
    const SharedImage image = pictures_.picture(now, fitted(pictures_.extent(), room));
    missing_ = !pictures_.complete();
    if (image && PictureSize{image->width, image->height} != extent_) {
      if (shown_) terminal_.write("\x1b[2J");
      picture_->forget();
      extent_ = {image->width, image->height};
    }
    if (image) terminal_.write(picture_->shown(*image));
    shown_ = true;
    shown_frame_ = now;
    show_status();
  }

  void show_status() {
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, " %u/%u  %g frames/s%s%s  ", shown_frame_, pictures_.frames() - 1,
                  pictures_.rate() * speed_, paused_ ? "  paused" : "", loop_ ? "" : "  once");
    std::string status =
        numbers + pictures_.state() + (missing_ ? "  rendering ..." : "") + (help_ ? "" : "  h help  q quit");
    const std::uint32_t lines = terminal_.cells().height;
    const std::vector<std::string> help = this->help();
    for (std::uint32_t i = 0; i < help.size(); ++i)
      if (lines + i > help.size()) write_line(lines + i - static_cast<std::uint32_t>(help.size()), help[i]);
    write_line(lines, status);
  }

  // The lines above the status.
  std::vector<std::string> help() const {
    std::vector<std::string> lines;
    if (!help_) return lines;
    std::istringstream keys(pictures_.keys() + std::string(kOwnKeys));
    for (std::string line; std::getline(keys, line);) lines.push_back(line);
    return lines;
  }

  void write_line(std::uint32_t line, std::string text) {
    text.resize(std::min<std::size_t>(text.size(), terminal_.cells().width));
    terminal_.write("\x1b[" + std::to_string(line) + ";1H\x1b[0m" + text + "\x1b[K");
  }

  void empty() {
    picture_->forget();
    shown_ = false;
  }

  // False: the person has seen enough.
  bool obey(const KeyPress& key) {
    const double at = due();
    switch (key.special == Special::none ? key.character : 0) {
      case 'q': case '\x03': return false;
      case ' ': go_on_from(at); paused_ = !paused_; break;
      case '.': step(1); break;
      case ',': step(-1); break;
      case ']': speed_ = std::min(speed_ * 2, 16.0); go_on_from(at); break;
      case '[': speed_ = std::max(speed_ / 2, 1.0 / 64); go_on_from(at); break;
      case 'l': go_on_from(at); loop_ = !loop_; break;
      case 'h': case '?':
        help_ = !help_;
        terminal_.write("\x1b[2J");
        empty();
        break;
      default:
        if (key.special == Special::home) go_on_from(0);
        if (key.special == Special::end) go_on_from(pictures_.frames() - 1);
        if (key.special != Special::home && key.special != Special::end && !pictures_.obey(key)) return true;
    }
    shown_ = false;
    return true;
  }

  void step(int frames) {
    const auto count = static_cast<std::int64_t>(pictures_.frames());
    const std::int64_t next = (static_cast<std::int64_t>(frame()) + frames + count) % count;
    paused_ = true;
    go_on_from(static_cast<double>(next));
  }

  Pictures& pictures_;
  Terminal& terminal_;
  std::unique_ptr<TerminalPicture> picture_;
  double at_ = 0;  // frame at which it went on at start_
  Clock::time_point start_;
  double speed_ = 1;
  bool paused_ = false, loop_ = true, help_ = false;
  bool shown_ = false;    // what is due stands on the screen
  bool missing_ = false;  // it was not ready
  std::uint32_t shown_frame_ = 0;
  PictureSize extent_{0, 0};
};

}  // namespace

int play(Pictures& pictures, Terminal& terminal) { return Player(pictures, terminal).play(); }

}  // namespace mars::host
