#include "host/render/serve/live_view.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "host/render/compositor/rectangles.h"

namespace mars::serve {
namespace {

constexpr std::uint32_t kOpaque = 0xff000000;

std::uint64_t pixels_in(const std::vector<Rect>& rects) {
  std::uint64_t pixels = 0;
  for (const Rect& rect : rects) pixels += std::uint64_t{rect.width} * rect.height;
  return pixels;
}

// Where the pixels end.
std::byte* copy_pixels(const compositor::Frame& frame, const Rect& rect, std::byte* to) {
  const std::uint32_t* line = &frame.pixels[std::size_t{rect.y} * frame.width + rect.x];
  for (std::uint32_t y = 0; y < rect.height; ++y, line += frame.width) {
    for (std::uint32_t x = 0; x < rect.width; ++x, to += sizeof(std::uint32_t)) {
      const std::uint32_t pixel = line[x] | kOpaque;
      std::memcpy(to, &pixel, sizeof pixel);
    }
  }
  return to;
}

}  // namespace

LiveView::LiveView(std::uint32_t width, std::uint32_t height, std::uint32_t block)
    : width_(width), height_(height), block_(block), compositor_(width, height, block) {}

void LiveView::begin_interval(std::uint64_t plain, bool alone) {
  compositor_.begin_interval(plain);
  alone_ = alone;
}

compositor::Frame* LiveView::begin_picture() {
  if (free_.empty()) free_.push_back(&frames_.emplace_back(width_, height_, block_));
  compositor::Frame* frame = free_.back();
  free_.pop_back();
  compositor_.begin_frame(*frame);
  return frame;
}

void LiveView::paste(const farm::StripMessage& strip, compositor::Frame& picture) {
  if (alone_) return compositor_.paste_moving(picture, strip.runs(), strip.pixels());
  compositor_.paste_constant(strip.constant_runs(), strip.constant_pixels(), &picture);
  compositor_.paste_moving(picture, strip.moving_runs(), strip.moving_pixels());
}

void LiveView::give_up(compositor::Frame* picture) { free_.push_back(picture); }

std::uint32_t LiveView::finish(compositor::Frame* picture, std::uint32_t number, std::size_t room,
                               std::vector<std::byte>& message) {
  compositor_.finish_frame(*picture, number);
  compositor_.restore(*picture);
  free_.push_back(picture);
  const std::vector<Rect> rects = compositor::rectangles_of(picture->changed, width_, height_);
  const std::size_t rect_bytes = rects.size() * sizeof(Rect);
  message.resize(room + rect_bytes + pixels_in(rects) * sizeof(std::uint32_t));
  std::byte* to = std::ranges::copy(std::as_bytes(std::span(rects)), message.data() + room).out;
  for (const Rect& rect : rects) to = copy_pixels(*picture, rect, to);
  return static_cast<std::uint32_t>(rects.size());
}

}  // namespace mars::serve
