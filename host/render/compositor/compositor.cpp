#include "host/render/compositor/compositor.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <string>

#include "hal/failure/failure.h"
#include "host/render/compositor/blocks.h"
#include "host/render/compositor/plain_pixels.h"
#include "host/render/compositor/runs.h"

namespace mars::compositor {

namespace {

// Frames outlive compositors and pass between them, so no two backgrounds of a process share a name.
std::uint64_t new_name() {
  static std::atomic<std::uint64_t> names{0};
  return ++names;
}

// Calls visit(row, part) for each stretch of `runs` within one row of blocks.
template <typename Visit>
void for_rows(std::span<const wire::Run> runs, std::uint32_t block, Visit visit) {
  for (std::size_t first = 0, last; first < runs.size(); first = last) {
    const std::uint32_t row = runs[first].line / block;
    last = first + 1;
    while (last < runs.size() && runs[last].line - row * block < block) ++last;
    visit(row, runs.subspan(first, last - first));
  }
}

}  // namespace

Compositor::Compositor(std::uint32_t width, std::uint32_t height, std::uint32_t block, wire::PixelFormat format)
    : width_(width),
      height_(height),
      format_(format),
      pixel_words_(wire::pixel_words(format)),
      background_(std::make_shared<Background>(width, height, block, format)),
      last_overwritten_(width, height, block),
      fresh_(width, height, block),
      filled_lines_(background_->constant.columns()) {}

// Frames of the interval before may still be on their way.
void Compositor::begin_interval(std::uint64_t plain) {
  if (name_ != 0 || background_->plain != plain) begin_background(plain);
  name_ = 0;
  last_number_.reset();
}

void Compositor::begin_background(std::uint64_t plain) {
  background_ = std::make_shared<Background>(width_, height_, background_->constant.block(), format_);
  background_->plain = plain;
}

void Compositor::paste_constant(std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels,
                                Frame* keyframe) {
  check_runs(runs, pixels.size());
  check(keyframe == nullptr || keyframe->background == name_, "a keyframe has all CFB so far");
  if (runs.empty()) return;
  // Intervals before, which showed nothing, may have shown this one: whoever knows it (FrameEncoder) must not take it
  // for the new one.
  if (name_ == 0) begin_background(background_->plain);
  if (keyframe != nullptr) keyframe->shown = background_;
  name_ = new_name();
  count_pasted(runs, pixels);
  if (keyframe != nullptr) count_pasted(runs, pixels);
  if (!background_->saved)
    background_->saved = std::make_unique_for_overwrite<std::uint32_t[]>(pixel_words_ * width_ * height_);
  const Extent extent{width_, height_, pixel_words_};
  const std::uint32_t* source = pixels.data();
  for_rows(runs, background_->constant.block(), [&](std::uint32_t row, std::span<const wire::Run> part) {
    extend_background(row, part);
    const std::uint32_t* end = copy_runs(part, source, extent, background_->saved.get());
    if (keyframe != nullptr) {
      refresh(*keyframe, row, part);
      copy_runs(part, source, extent, keyframe->pixels.data());
    }
    source = end;
  });
  if (keyframe == nullptr) return;
  keyframe->background = name_;
  keyframe->constant = background_->constant;
}

// Blocks that the runs are the first to touch become plain background.
void Compositor::extend_background(std::uint32_t row, std::span<const wire::Run> runs) {
  for (const wire::Run& run : runs) fresh_.set_pixels(run.line, run.first, run.count);
  fresh_.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
    background_->constant.for_parts(row, first, last, [&](std::uint32_t from, std::uint32_t to, bool known) {
      if (known) return;
      for_lines({width_, height_, pixel_words_}, background_->constant.block(), row, from, to,
                [&](std::size_t at, std::size_t count) {
                  fill_pixels({&background_->saved[at], count}, background_->plain, format_);
                  counts_.restored += count * sizeof(std::uint32_t);
                });
    });
  });
  background_->constant.add_row(fresh_, row);
  fresh_.clear_row(row);
}

void Compositor::begin_frame(Frame& frame) const {
  check(frame.width == width_ && frame.height == height_ && frame.format == format_,
        "a frame has the compositor's size and format");
  check(frame.overwritten.block() == background_->constant.block(), "a frame has the compositor's blocks");
  if (frame.plain != background_->plain) {
    frame.stale.set_all();
  } else {
    frame.stale |= frame.overwritten;
    if (frame.background != name_) {
      frame.stale |= frame.constant;
      frame.stale |= background_->constant;
    }
  }
  frame.overwritten.clear();
  frame.plain = background_->plain;
  frame.shown = background_;
  frame.background = name_;
  frame.constant = background_->constant;
}

// Stale blocks of the row show the background again, but for those that the runs are about to fill.
void Compositor::refresh(Frame& frame, std::uint32_t row, std::span<const wire::Run> runs) {
  if (!frame.stale.any(row)) return;
  count_filled_lines(runs);
  const std::uint32_t lines = std::min(background_->constant.block(), height_ - row * background_->constant.block());
  const auto is_filled = [&](std::uint32_t column) { return filled_lines_[column] == lines; };
  frame.stale.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
    while (first < last) {
      std::uint32_t end = first;
      while (end < last && !is_filled(end)) ++end;
      counts_.restored += background_->write(frame.pixels.data(), row, first, end);
      first = end + 1;
    }
  });
  frame.stale.clear_row(row);
}

// In how many lines of each block the runs, which lie in one row, fill it from side to side. None where runs are not in
// order, as those of a sound node are.
void Compositor::count_filled_lines(std::span<const wire::Run> runs) {
  const std::uint32_t block = background_->constant.block();
  std::ranges::fill(filled_lines_, 0);
  const auto add = [&](std::uint32_t first, std::uint32_t last) {
    const std::uint32_t end = last == width_ ? background_->constant.columns() : last / block;
    for (std::uint32_t column = (first + block - 1) / block; column < end; ++column) ++filled_lines_[column];
  };
  std::uint32_t line = runs.front().line, first = runs.front().first, last = first;
  for (const wire::Run& run : runs) {
    if (run.line != line || run.first != last) {
      if (run.line < line || (run.line == line && run.first < last)) return void(std::ranges::fill(filled_lines_, 0));
      add(first, last);
      line = run.line;
      first = run.first;
    }
    last = run.first + std::uint32_t{run.count};
  }
  add(first, last);
}

void Compositor::paste_moving(Frame& frame, std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels) {
  check_runs(runs, pixels.size());
  count_pasted(runs, pixels);
  const Extent extent{width_, height_, pixel_words_};
  const std::uint32_t* source = pixels.data();
  for_rows(runs, background_->constant.block(), [&](std::uint32_t row, std::span<const wire::Run> part) {
    refresh(frame, row, part);
    source = copy_runs(part, source, extent, frame.pixels.data());
    for (const wire::Run& run : part) frame.overwritten.set_pixels(run.line, run.first, run.count);
  });
}

void Compositor::read_line(const Frame& frame, std::uint32_t line, std::span<std::uint32_t> words) const {
  const std::size_t width = pixel_words_ * width_, block = pixel_words_ * background_->constant.block(),
                    row = line / background_->constant.block();
  const std::size_t at = line * width;
  std::copy_n(&frame.pixels[at], width, words.data());
  frame.stale.for_stretches(static_cast<std::uint32_t>(row), [&](std::uint32_t first, std::uint32_t last) {
    background_->constant.for_parts(static_cast<std::uint32_t>(row), first, last,
                                    [&](std::uint32_t from, std::uint32_t to, bool drawn) {
                                      const std::size_t left = from * block, count = std::min(width, to * block) - left;
                                      if (drawn)
                                        std::copy_n(&background_->saved[at + left], count, &words[left]);
                                      else
                                        fill_pixels(words.subspan(left, count), background_->plain, format_);
                                    });
  });
}

void Compositor::restore(Frame& frame) { counts_.restored += frame.restore({0, height_}); }

void Compositor::finish_frame(Frame& frame, std::uint32_t number) {
  frame.number = number;
  frame.changed_since = last_number_;
  if (last_number_) {
    frame.changed = frame.overwritten;
    frame.changed |= last_overwritten_;
  } else {
    frame.changed.set_all();
  }
  last_overwritten_ = frame.overwritten;
  last_number_ = number;
}

void Compositor::count_pasted(std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels) {
  counts_.runs += runs.size();
  counts_.bytes += pixels.size_bytes();
}

void Compositor::check_runs(std::span<const wire::Run> runs, std::size_t words) const {
  std::size_t counted = 0;
  for (const wire::Run& run : runs) {
    if (run.count == 0 || run.line >= height_ || std::uint32_t{run.first} + run.count > width_) {
      throw Failure("a strip draws outside the picture: " + std::to_string(run.count) + " pixels from column " +
                        std::to_string(run.first) + " of line " + std::to_string(run.line),
                    "a picture of " + std::to_string(width_) + "x" + std::to_string(height_) + " pixels",
                    "run host and nodes of the same version");
    }
    counted += run.count;
  }
  if (counted * pixel_words_ != words) {
    throw Failure("a strip has " + std::to_string(words / pixel_words_) + " pixels where its runs count " +
                      std::to_string(counted),
                  "", "run host and nodes of the same version");
  }
}

}  // namespace mars::compositor
