#include "host/window/screen/rendering_show.h"

#include <sys/socket.h>

#include <utility>

#include "host/content/document/text.h"

namespace mars::window {
namespace {

using pictures::Kind;
using pictures::SpecialKey;

constexpr std::size_t kRated = 32;     // frames whose rate is shown
constexpr int kMessagesATurn = 64;     // before the window is updated
constexpr const char* kSep = "  -  ";  // between parts of the title

}  // namespace

RenderingShow::RenderingShow(std::string film, child::Descriptor listener)
    : film_(std::move(film)), listener_(std::move(listener)) {}

bool RenderingShow::handle_events() {
  for (const Event& event : screen_.events()) {
    if (std::holds_alternative<Closed>(event)) return false;
    if (const auto* key = std::get_if<pictures::Key>(&event); key && !handle_key(*key)) return false;
  }
  return true;
}

bool RenderingShow::handle_key(const pictures::Key& key) {
  Canvas& canvas = screen_.canvas();
  switch (key.character) {
    case 'q':
    case '\x03': return false;
    case 'f': canvas.outline(!canvas.outlines()); break;
    case '1': canvas.zoom(Zoom::one_to_one); break;
    case '0': canvas.zoom(Zoom::fit); break;
    default: break;
  }
  return key.special != SpecialKey::escape;
}

int RenderingShow::descriptor() const {
  return host_ ? host_->descriptor() : listener_.open() ? listener_.number() : -1;
}

void RenderingShow::accept() {
  child::Descriptor host(accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!host.open()) return;
  host_.emplace(std::move(host), pictures::Peer::host);
  begin_.reset();
}

bool RenderingShow::receive() {
  if (!host_ && listener_.open()) accept();
  if (!host_) return false;
  for (int count = 0; count < kMessagesATurn; ++count) {
    const auto message = host_->receive();
    if (!message) break;
    take(*message);
  }
  if (!host_->is_open()) host_.reset();
  return true;
}

void RenderingShow::take(const pictures::Message& message) {
  if (message.head.kind == Kind::begin) {
    begin_ = pictures::read_begin(message).begin;
    drawn_ = 0;
    seconds_.clear();
    screen_.begin(film_, {begin_->width, begin_->height});
  } else if (message.head.kind == Kind::picture) {
    const pictures::Picture picture = pictures::read_picture(message, begin_);
    frame_ = picture.head.frame;
    screen_.paste(picture);
  } else if (message.head.kind == Kind::drawn) {
    note_drawn(pictures::read_drawn(message).head.seconds);
  }
  screen_.set_title(title());
}

void RenderingShow::note_drawn(double seconds) {
  ++drawn_;
  seconds_.push_back(seconds);
  if (seconds_.size() > kRated) seconds_.pop_front();
}

// "demo.json  -  frame 37  -  20 of 96  -  12.3 frames/s"
std::string RenderingShow::title() const {
  if (!begin_) return film_;
  std::string text = film_ + kSep + "frame " + std::to_string(frame_) + kSep + std::to_string(drawn_) + " of " +
                     std::to_string(begin_->frames);
  if (finished_) return text + kSep + "ended";
  const double time = seconds_.empty() ? 0 : seconds_.back() - seconds_.front();
  if (time > 0) text += kSep + document::formatted("%.3g frames/s", static_cast<double>(seconds_.size() - 1) / time);
  return text;
}

void RenderingShow::finish() {
  if (finished_) return;
  finished_ = true;
  listener_.close();
  screen_.set_title(title());
}

}  // namespace mars::window
