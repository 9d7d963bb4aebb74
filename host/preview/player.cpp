#include "host/preview/player.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "host/content/document/text.h"
#include "host/content/document/text_lines.h"
#include "host/preview/terminal_picture.h"

namespace mars::preview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr images::PictureSize kLargest{1280, 720};  // pixels, of terminals that have many
constexpr std::string_view kTroubleColor = "\x1b[1;31m";
constexpr std::string_view kNoteColor = "\x1b[1m";
constexpr std::uint32_t kNoteLines = 2;
constexpr std::string_view kOwnKeys = " space pause  , . step  home end  [ ] speed  l loop  h help  q quit";

images::Image upper_part(const images::Image& image, std::uint32_t height) {
  const auto end = image.pixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{height} * image.width);
  return {image.width, height, {image.pixels.begin(), end}};
}

class Player {
 public:
  Player(Pictures& pictures, Terminal& terminal)
      : pictures_(pictures), terminal_(terminal), picture_(make_terminal_picture(terminal.graphics())) {}

  int play() {
    go_on_from(0);
    while (true) {
      renew();
      show();
      const TerminalEvents events = terminal_.wait(until_next());
      if (events.ended_by != 0) return events.ended_by;
      if (events.redraw) empty();
      for (const KeyPress& key : events.keys)
        if (!handle_key(key)) return 0;
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

  // Pictures that are others now go on from the same frame.
  void renew() {
    const double at = due();
    if (!pictures_.renew()) return;
    go_on_from(std::min<double>(at, pictures_.frames() - 1));
    shown_ = false;
  }

  // While nothing moves, pictures that are being rendered may still come, or become others.
  std::chrono::nanoseconds until_next() const {
    const double seconds = (std::floor(due()) + 1 - due()) / (pictures_.rate() * speed_);
    const double at_most = missing_ ? 0.05 : 0.1;
    return std::chrono::nanoseconds(static_cast<std::int64_t>(std::clamp(paused_ ? 1.0 : seconds, 0.0, at_most) * 1e9));
  }

  void show() {
    const std::uint32_t now = frame();
    std::vector<std::string> notes = this->notes(now);
    if (shown_ && !missing_ && now == shown_frame_ && notes == notes_ && status(now) == status_) return;
    for (std::size_t above = notes.size(); above < notes_.size(); ++above) write_line(above + 1, "");
    show_picture(now, notes.size());
    if (notes != notes_)
      for (std::size_t i = 0; i < notes.size(); ++i) write_line(notes.size() - i, notes[i]);
    notes_ = std::move(notes);
    write_line(0, status_ = status(now));
    shown_ = true;
    shown_frame_ = now;
  }

  // Its size leaves a line for the status; what would be behind `notes` lines more is left out.
  void show_picture(std::uint32_t now, std::size_t notes) {
    const images::PictureSize space = picture_->space(terminal_, 1);
    const images::PictureSize most{std::min(space.width, kLargest.width), std::min(space.height, kLargest.height)};
    SharedImage image = pictures_.picture(now, fitted(pictures_.extent(), most));
    missing_ = !pictures_.complete();
    if (!image) return;
    if (images::PictureSize{image->width, image->height} != extent_) {
      terminal_.write("\x1b[2J");
      empty();
      extent_ = {image->width, image->height};
    }
    const std::uint32_t height = picture_->space(terminal_, 1 + static_cast<std::uint32_t>(notes)).height;
    if (image->height > height) image = std::make_shared<const images::Image>(upper_part(*image, height));
    terminal_.write(picture_->shown(*image));
  }

  std::string status(std::uint32_t now) const {
    const std::string numbers =
        document::formatted(" %u/%u  %g frames/s%s%s  ", now, pictures_.frames() - 1, pictures_.rate() * speed_,
                            paused_ ? "  paused" : "", loop_ ? "" : "  once");
    return document::cut_to(numbers + pictures_.state() + (missing_ ? "  rendering ..." : "") +
                                (help_ ? "" : "  h help  q quit"),
                            terminal_.cells().width);
  }

  // What stands between the picture and the status.
  std::vector<std::string> notes(std::uint32_t now) const {
    const images::PictureSize cells = terminal_.cells();
    std::vector<std::string> notes;
    if (help_) {
      std::istringstream keys(pictures_.keys() + std::string(kOwnKeys));
      for (std::string line; std::getline(keys, line);) notes.push_back(document::cut_to(line, cells.width));
    }
    for (const std::string& line : document::wrapped(pictures_.note(now), cells.width - 1, kNoteLines))
      notes.push_back(std::string(kNoteColor) + " " + line);
    for (const std::string& line : document::wrapped(pictures_.trouble(), cells.width, std::max(cells.height / 3, 1u)))
      notes.push_back(std::string(kTroubleColor) + line);
    return notes;
  }

  // `above`: lines above the lowest one.
  void write_line(std::size_t above, const std::string& text) {
    const std::uint32_t lines = terminal_.cells().height;
    if (above < lines) terminal_.write("\x1b[" + std::to_string(lines - above) + ";1H\x1b[0m" + text + "\x1b[0m\x1b[K");
  }

  void empty() {
    picture_->forget();
    shown_ = false;
    notes_.clear();
  }

  // False: the person has seen enough.
  bool handle_key(const KeyPress& key) {
    const double at = due();
    switch (key.special == Special::none ? key.character : 0) {
      case 'q':
      case '\x03': return false;
      case ' ':
        go_on_from(at);
        paused_ = !paused_;
        break;
      case '.': step(1); break;
      case ',': step(-1); break;
      case ']':
        speed_ = std::min(speed_ * 2, 16.0);
        go_on_from(at);
        break;
      case '[':
        speed_ = std::max(speed_ / 2, 1.0 / 64);
        go_on_from(at);
        break;
      case 'l':
        go_on_from(at);
        loop_ = !loop_;
        break;
      case 'h':
      case '?': help_ = !help_; break;
      default:
        if (key.special == Special::home) go_on_from(0);
        if (key.special == Special::end) go_on_from(pictures_.frames() - 1);
        if (key.special != Special::home && key.special != Special::end && !pictures_.handle_key(key, frame()))
          return true;
    }
    if (pictures_.holds()) hold();
    shown_ = false;
    return true;
  }

  void hold() {
    go_on_from(frame());
    paused_ = true;
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
  std::vector<std::string> notes_;  // as they stand on the screen
  std::string status_;
  images::PictureSize extent_{0, 0};
};

}  // namespace

int play(Pictures& pictures, Terminal& terminal) { return Player(pictures, terminal).play(); }

}  // namespace mars::preview
