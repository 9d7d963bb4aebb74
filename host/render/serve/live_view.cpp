#include "host/render/serve/live_view.h"

#include "host/render/compositor/rectangles.h"

namespace mars::serve {

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

pictures::Picture LiveView::finish(compositor::Frame* picture, std::uint32_t number) {
  compositor_.finish_frame(*picture, number);
  compositor_.restore(*picture);
  free_.push_back(picture);
  pictures::Picture shown;
  shown.head.width = width_;
  shown.head.height = height_;
  shown.head.whole = 1;
  shown.rects = compositor::rectangles_of(picture->changed, width_, height_);
  shown.pixels = pictures::cut_opaque(picture->pixels, width_, shown.rects);
  return shown;
}

}  // namespace mars::serve
