#include "host/preview/player.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "host/content/document/text.h"

namespace mars::preview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kOwnKeys = " space pause  , . step  home end  [ ] speed  l loop  h help  q quit";

class Player {
 public:
  Player(Pictures& pictures, Screen& screen) : pictures_(pictures), screen_(screen) {}

  int play() {
    go_on_from(0);
    while (true) {
      renew();
      show();
      const ScreenEvents events = screen_.wait(until_next());
      if (events.ended_by != 0 || events.closed) return events.ended_by;
      if (events.redraw) shown_ = false;
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
    const Words words = this->words(now);
    if (!screen_.is_ready() || (shown_ && !missing_ && now == shown_frame_ && words == words_)) return;
    const SharedImage image = pictures_.picture(now, fitted(pictures_.extent(), screen_.space()));
    missing_ = !pictures_.complete();
    words_ = this->words(now);
    screen_.show(image, words_);
    shown_ = true;
    shown_frame_ = now;
  }

  Words words(std::uint32_t now) const {
    return {help_ ? pictures_.keys() + std::string(kOwnKeys) : "", pictures_.note(now), pictures_.trouble(),
            status(now)};
  }

  std::string status(std::uint32_t now) const {
    return document::formatted(" %u/%u  %g frames/s%s%s  ", now, pictures_.frames() - 1, pictures_.rate() * speed_,
                               paused_ ? "  paused" : "", loop_ ? "" : "  once") +
           pictures_.state() + (missing_ ? "  rendering ..." : "") + (help_ ? "" : "  h help  q quit");
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
  Screen& screen_;
  double at_ = 0;  // frame at which it went on at start_
  Clock::time_point start_;
  double speed_ = 1;
  bool paused_ = false, loop_ = true, help_ = false;
  bool shown_ = false;    // what is due stands on the screen
  bool missing_ = false;  // it was not ready
  std::uint32_t shown_frame_ = 0;
  Words words_;  // that stand beside it
};

}  // namespace

int play(Pictures& pictures, Screen& screen) { return Player(pictures, screen).play(); }

}  // namespace mars::preview
