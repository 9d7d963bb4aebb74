#include "host/window/screen/screen.h"

namespace mars::window {
namespace {

constexpr std::chrono::milliseconds kTitleRest{250};  // between titles: they change more often than anyone reads

}  // namespace

void Screen::begin(const std::string& title, images::PictureSize picture) {
  if (!window_.is_open()) {
    window_.open(title, picture);
    canvas_.resize(window_.size());
    title_ = shown_title_ = title;
  }
  begin_picture(picture);
}

void Screen::begin_picture(images::PictureSize picture) {
  picture_ = picture;
  canvas_.begin(picture);
}

void Screen::paste(const pictures::Picture& picture) {
  const images::PictureSize size{picture.head.width, picture.head.height};
  if (size != picture_) begin_picture(size);
  canvas_.paste(picture.rects, picture.pixels);
  has_picture_ = true;
}

void Screen::set_title(const std::string& title) { title_ = title; }

std::vector<Event> Screen::events() {
  std::vector<Event> events = window_.events();
  for (const Event& event : events) {
    if (std::holds_alternative<Exposed>(event) && window_.is_open()) canvas_.resize(window_.size());
    if (const auto* drag = std::get_if<Dragged>(&event)) canvas_.move(drag->by);
  }
  return events;
}

// A window without a picture is not worth its bytes.
void Screen::update() {
  if (!window_.is_open() || !has_picture_) return;
  const std::vector<Area> areas = canvas_.take_changed();
  if (!areas.empty()) window_.show(canvas_, areas);
  update_title();
}

void Screen::update_title() {
  const auto now = Clock::now();
  if (title_ == shown_title_ || now - titled_ < kTitleRest) return;
  window_.set_title(shown_title_ = title_);
  titled_ = now;
}

}  // namespace mars::window
