#include "host/render/watch/watched_picture.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "host/render/compositor/rectangles.h"

namespace mars::watch {
using compositor::BlockFlags;

WatchedPicture::WatchedPicture(std::uint32_t width, std::uint32_t height, std::uint32_t block, wire::PixelFormat format)
    : width_(width),
      height_(height),
      pixel_words_(wire::pixel_words(format)),
      words_(std::size_t{width} * height * pixel_words_),
      marks_(std::size_t{width} * height),
      still_(marks_.size()),
      lines_(height, Line{-1, 0}),
      pending_(width, height, block),
      line_words_(width * pixel_words_) {
  pending_.set_all();
  head_.width = width;
  head_.height = height;
}

void WatchedPicture::follow(std::uint32_t group) {
  group_ = group;
  in_step_ = false;
  inbetweens_.clear();
  keyframe_lines_ = 0;
  std::ranges::fill(still_, Mark::unknown);
}

void WatchedPicture::paste(const PastedStrip& strip, const compositor::Compositor& compositor,
                           const compositor::Frame& frame, double seconds) {
  const wire::Strip& header = strip.header;
  if (header.kind == wire::FrameKind::inbetween) {
    Inbetween& inbetween = inbetweens_[header.frame];
    inbetween.moving.insert(inbetween.moving.end(), strip.moving.begin(), strip.moving.end());
    inbetween.edge_boxes.resize(height_);
    std::ranges::copy(strip.edge_boxes, inbetween.edge_boxes.begin() + header.first_line);
    inbetween.lines += header.last_line - header.first_line;
    return;
  }
  if (!in_step_ || head_.whole == 1 || head_.frame != header.frame || keyframe_lines_ == 0) begin_keyframe(header);
  head_.seconds = seconds;
  keyframe_lines_ += header.last_line - header.first_line;
  mark_lines(strip);
  for (std::uint32_t line = header.first_line; line < header.last_line; ++line) {
    compositor.read_line(frame, line, line_words_);
    put_line(line, line_words_, std::span(line_marks_).subspan(std::size_t{line - header.first_line} * width_, width_));
    lines_[line] = {header.node, strip.edge_boxes[line - header.first_line]};
  }
  news_ = begun_ = true;
}

void WatchedPicture::begin_frame(std::uint32_t frame, std::uint32_t interval, wire::FrameKind kind) {
  head_.frame = frame;
  head_.interval = interval;
  head_.kind = kind;
  head_.group = group_;
  in_step_ = true;
  keyframe_lines_ = 0;
}

void WatchedPicture::begin_keyframe(const wire::Strip& header) {
  begin_frame(header.frame, header.interval, header.kind);
  head_.whole = 0;
  inbetweens_.clear();
  std::ranges::fill(lines_, Line{-1, 0});
}

// Its lines' pixels, for put_line and for the inbetweens.
void WatchedPicture::mark_lines(const PastedStrip& strip) {
  const std::size_t first = std::size_t{strip.header.first_line} * width_;
  const std::size_t count = std::size_t{strip.header.last_line - strip.header.first_line} * width_;
  const auto lines = std::span(still_).subspan(first, count);  // a node may have none, at the picture's end
  std::ranges::fill(lines, Mark::nothing);
  for (const wire::Run& run : strip.constant)
    std::fill_n(&still_[std::size_t{run.line} * width_ + run.first], run.count, Mark::still);
  line_marks_.assign(lines.begin(), lines.end());
  for (const wire::Run& run : strip.moving)
    std::fill_n(&line_marks_[std::size_t{run.line} * width_ + run.first - first], run.count, Mark::moving);
}

// Only blocks that it changes are to be sent.
void WatchedPicture::put_line(std::uint32_t line, std::span<const std::uint32_t> words, std::span<const Mark> marks) {
  const std::size_t at = std::size_t{line} * width_;
  for (std::uint32_t left = 0; left < width_; left += pending_.block()) {
    const std::uint32_t count = std::min(pending_.block(), width_ - left);
    std::uint32_t* to = &words_[(at + left) * pixel_words_];
    const std::size_t bytes = count * pixel_words_ * sizeof *to;
    if (std::memcmp(to, &words[left * pixel_words_], bytes) == 0 &&
        std::memcmp(&marks_[at + left], &marks[left], count) == 0)
      continue;
    std::memcpy(to, &words[left * pixel_words_], bytes);
    std::memcpy(&marks_[at + left], &marks[left], count);
    pending_.set_pixels(line, left, count);
  }
}

void WatchedPicture::finish(const compositor::Frame& frame, std::uint32_t interval, wire::FrameKind kind,
                            std::int32_t first_node, double seconds) {
  if (kind == wire::FrameKind::inbetween)
    finish_inbetween(frame, interval, first_node);
  else if (head_.frame != frame.number || keyframe_lines_ != height_)
    put_whole(frame);
  begin_frame(frame.number, interval, kind);
  head_.whole = 1;
  head_.seconds = seconds;
  news_ = begun_ = true;
}

// Whether the picture is the frame before, in the compositor's order.
bool WatchedPicture::follows(const compositor::Frame& frame, std::uint32_t interval) const {
  return in_step_ && head_.whole == 1 && head_.interval == interval && frame.changed_since == head_.frame;
}

void WatchedPicture::finish_inbetween(const compositor::Frame& frame, std::uint32_t interval, std::int32_t node) {
  const Inbetween drawn = std::move(inbetweens_[frame.number]);
  inbetweens_.erase(frame.number);
  if (!follows(frame, interval) || drawn.lines != height_) return put_whole(frame);
  put_blocks(frame, frame.changed);
  for (const wire::Run& run : drawn.moving)
    std::fill_n(&marks_[std::size_t{run.line} * width_ + run.first], run.count, Mark::moving);
  for (std::uint32_t line = 0; line < height_; ++line) lines_[line] = {node, drawn.edge_boxes[line]};
}

void WatchedPicture::put_blocks(const compositor::Frame& frame, const BlockFlags& blocks) {
  for (std::uint32_t row = 0; row < blocks.rows(); ++row)
    blocks.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
      const std::uint32_t left = first * blocks.block(), count = std::min(width_, last * blocks.block()) - left;
      const std::uint32_t bottom = std::min(height_, (row + 1) * blocks.block());
      for (std::uint32_t line = row * blocks.block(); line < bottom; ++line) {
        const std::size_t at = std::size_t{line} * width_ + left;
        std::memcpy(&words_[at * pixel_words_], &frame.pixels[at * pixel_words_],
                    count * pixel_words_ * sizeof frame.pixels[0]);
        std::memcpy(&marks_[at], &still_[at], count);
      }
    });
  pending_ |= blocks;
}

// Of which not all strips were seen.
void WatchedPicture::put_whole(const compositor::Frame& frame) {
  std::ranges::fill(still_, Mark::unknown);
  std::ranges::copy(frame.pixels, words_.begin());
  std::ranges::copy(still_, marks_.begin());
  std::ranges::fill(lines_, Line{-1, 0});
  pending_.set_all();
}

void WatchedPicture::forget_sent() {
  pending_.set_all();
  news_ = begun_;
}

PictureUpdate WatchedPicture::take() {
  PictureUpdate update{{0, 0, head_, compositor::rectangles_of(pending_, width_, height_), lines_, {}}, {}};
  std::vector<std::uint32_t>& words = update.picture.pixels;
  pictures::for_rows(update.picture.rects, width_, [&](std::size_t at, std::size_t count) {
    const auto* first = &words_[at * pixel_words_];
    words.insert(words.end(), first, first + count * pixel_words_);
    update.marks.insert(update.marks.end(), &marks_[at], &marks_[at] + count);
  });
  pending_.clear();
  news_ = false;
  return update;
}

}  // namespace mars::watch
