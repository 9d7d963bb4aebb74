#include "host/window/screen/canvas.h"

#include <algorithm>
#include <utility>

#include "host/render/pictures/reading.h"

namespace mars::window {
namespace {

constexpr std::uint32_t kBlack = 0, kOutline = 0x0000d7ff;  // a yellow

std::size_t pixels_of(images::PictureSize size) { return std::size_t{size.width} * size.height; }

}  // namespace

void Canvas::begin(images::PictureSize picture) {
  picture_ = picture;
  whole_.assign(pixels_of(picture), kBlack);
  shift_ = {};
  all_ = true;
}

void Canvas::resize(images::PictureSize window) {
  window_ = window;
  pixels_.assign(pixels_of(window), kBlack);
  all_ = true;
}

void Canvas::zoom(Zoom zoom) {
  all_ = all_ || zoom != zoom_;
  zoom_ = zoom;
  shift_ = {};
}

// Not farther than the picture reaches: what a person moves too far would have to be moved back first.
void Canvas::move(Shift by) {
  const auto reach = [](std::uint32_t picture, std::uint32_t window) {
    return picture > window ? static_cast<std::int32_t>((picture - window + 1) / 2) : 0;
  };
  const std::int32_t across = reach(picture_.width, window_.width), down = reach(picture_.height, window_.height);
  shift_ = {std::clamp(shift_.x + by.x, -across, across), std::clamp(shift_.y + by.y, -down, down)};
  all_ = all_ || zoom_ == Zoom::one_to_one;
}

void Canvas::outline(bool flags) {
  outline_ = flags;
  outlined_.clear();
  all_ = true;
}

void Canvas::paste(std::span<const compositor::Rect> rects, std::span<const std::uint32_t> pixels) {
  pictures::paste(pixels, rects, picture_.width, whole_);
  came_.insert(came_.end(), rects.begin(), rects.end());
}

std::vector<Area> Canvas::take_changed() {
  std::vector<compositor::Rect> rects = std::exchange(came_, {});
  if (!rects.empty()) {
    std::vector<compositor::Rect> before = std::exchange(outlined_, outline_ ? rects : std::vector<compositor::Rect>());
    rects.insert(rects.end(), before.begin(), before.end());
  }
  if (std::exchange(all_, false)) {
    draw_all();
    draw_outlines();
    return {{0, 0, window_.width, window_.height}};
  }
  const Placement placement(picture_, window_, zoom_, shift_);
  std::vector<Area> areas;
  for (const compositor::Rect& rect : rects) {
    const Area area = placement.shown(rect);
    if (area.empty()) continue;
    placement.draw(whole_, area, pixels_);
    areas.push_back(area);
  }
  draw_outlines();
  return areas;
}

void Canvas::draw_all() {
  std::ranges::fill(pixels_, kBlack);
  const Placement placement(picture_, window_, zoom_, shift_);
  const compositor::Rect whole{0, 0, static_cast<std::uint16_t>(picture_.width),
                               static_cast<std::uint16_t>(picture_.height)};
  placement.draw(whole_, placement.shown(whole), pixels_);
}

void Canvas::draw_outlines() {
  const Placement placement(picture_, window_, zoom_, shift_);
  for (const compositor::Rect& rect : outlined_)
    if (const Area area = placement.shown(rect); !area.empty()) frame(area);
}

void Canvas::frame(const Area& area) {
  const auto fill = [&](std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) {
    for (std::uint32_t line = y; line < y + height; ++line)
      std::fill_n(&pixels_[std::size_t{line} * window_.width + x], width, kOutline);
  };
  fill(area.x, area.y, area.width, 1);
  fill(area.x, area.y + area.height - 1, area.width, 1);
  fill(area.x, area.y, 1, area.height);
  fill(area.x + area.width - 1, area.y, 1, area.height);
}

}  // namespace mars::window
