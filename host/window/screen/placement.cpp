#include "host/window/screen/placement.h"

#include <algorithm>
#include <vector>

namespace mars::window {
namespace {

using images::PictureSize;

std::uint32_t reduced(std::uint32_t pixels, std::uint32_t window, std::uint32_t other) {
  return std::max(1u, static_cast<std::uint32_t>((std::uint64_t{pixels} * window + other / 2) / other));
}

PictureSize fitted(PictureSize picture, PictureSize window) {
  const std::uint32_t factor = std::min(window.width / picture.width, window.height / picture.height);
  if (factor >= 1) return {picture.width * factor, picture.height * factor};
  if (std::uint64_t{window.width} * picture.height <= std::uint64_t{window.height} * picture.width)
    return {window.width, reduced(picture.height, window.width, picture.width)};
  return {reduced(picture.width, window.height, picture.height), window.height};
}

// A picture that fits stands in the middle; no window shows more beside a larger one than it has to.
std::int64_t begin_of(std::uint32_t shown, std::uint32_t window, std::int32_t shift) {
  const std::int64_t room = std::int64_t{window} - shown;
  return room >= 0 ? room / 2 : std::clamp<std::int64_t>(room / 2 + shift, room, 0);
}

// The mean of pixels [from, to) of lines [first, last).
std::uint32_t mean(std::span<const std::uint32_t> picture, std::uint32_t width, std::uint32_t from, std::uint32_t to,
                   std::uint32_t first, std::uint32_t last) {
  std::uint64_t red = 0, green = 0, blue = 0;
  for (std::uint32_t line = first; line < last; ++line)
    for (const std::uint32_t pixel : picture.subspan(std::size_t{line} * width + from, to - from)) {
      red += pixel & 0xff;
      green += pixel >> 8 & 0xff;
      blue += pixel >> 16 & 0xff;
    }
  const std::uint64_t count = std::uint64_t{to - from} * (last - first), half = count / 2;
  return static_cast<std::uint32_t>((red + half) / count | (green + half) / count << 8 | (blue + half) / count << 16);
}

}  // namespace

Axis::Axis(std::uint32_t pixels, std::uint32_t shown, std::uint32_t window, std::int32_t shift)
    : pixels_(pixels), shown_(shown), window_(window), begin_(begin_of(shown, window, shift)) {}

std::uint32_t Axis::first(std::uint32_t from) const {
  const auto at = static_cast<std::int64_t>(std::uint64_t{from} * shown_ / pixels_);
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(begin_ + at, 0, window_));
}

std::uint32_t Axis::last(std::uint32_t to) const {
  const auto at = static_cast<std::int64_t>((std::uint64_t{to} * shown_ + pixels_ - 1) / pixels_);
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(begin_ + at, 0, window_));
}

std::uint32_t Axis::from(std::uint32_t at) const {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(at - begin_) * pixels_ / shown_);
}

std::uint32_t Axis::to(std::uint32_t at) const {
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(at + 1 - begin_) * pixels_ + shown_ - 1) / shown_);
}

Placement::Placement(PictureSize picture, PictureSize window, Zoom zoom, Shift shift)
    : Placement(picture, zoom == Zoom::fit ? fitted(picture, window) : picture, window, shift) {}

Placement::Placement(PictureSize picture, PictureSize shown, PictureSize window, Shift shift)
    : picture_(picture),
      window_(window),
      across_(picture.width, shown.width, window.width, shift.x),
      down_(picture.height, shown.height, window.height, shift.y) {}

Area Placement::shown(const compositor::Rect& rect) const {
  const std::uint32_t x = across_.first(rect.x), y = down_.first(rect.y);
  return {x, y, across_.last(std::uint32_t{rect.x} + rect.width) - x,
          down_.last(std::uint32_t{rect.y} + rect.height) - y};
}

void Placement::draw(std::span<const std::uint32_t> picture, const Area& area, std::span<std::uint32_t> window) const {
  struct Columns {
    std::uint32_t from, to;
  };
  std::vector<Columns> columns;
  for (std::uint32_t x = area.x; x < area.x + area.width; ++x) columns.push_back({across_.from(x), across_.to(x)});
  for (std::uint32_t y = area.y; y < area.y + area.height; ++y) {
    const std::uint32_t first = down_.from(y), last = down_.to(y);
    std::uint32_t* to = window.subspan(std::size_t{y} * window_.width + area.x, area.width).data();
    for (const Columns& each : columns) *to++ = mean(picture, picture_.width, each.from, each.to, first, last);
  }
}

}  // namespace mars::window
