#include "host/render/compositor/compositor.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <string>

#include "hal/failure/failure.h"

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

// Calls visit(at, count) for each line of pixels in the blocks [first, last) of a row.
template <typename Visit>
void for_lines(std::uint32_t width, std::uint32_t height, std::uint32_t block, std::uint32_t row, std::uint32_t first,
               std::uint32_t last, Visit visit) {
  const std::size_t left = std::size_t{first} * block;
  const std::size_t right = std::min<std::size_t>(width, std::size_t{last} * block);
  const std::size_t top = std::size_t{row} * block;
  const std::size_t bottom = std::min<std::size_t>(height, top + block);
  for (std::size_t line = top; line < bottom; ++line) visit(line * width + left, right - left);
}

// The first and the last `n` of `count` pixels, n <= count <= 2n: all of them.
template <std::size_t n>
void copy_ends(const std::uint32_t* from, std::size_t count, std::uint32_t* to) {
  std::memcpy(to, from, n * sizeof *from);
  std::memcpy(to + count - n, from + count - n, n * sizeof *from);
}

// Short runs are too many to call memcpy for each.
void copy_run(const std::uint32_t* from, std::size_t count, std::uint32_t* to) {
  if (count > 16)
    std::memcpy(to, from, count * sizeof *from);
  else if (count >= 8)
    copy_ends<8>(from, count, to);
  else if (count >= 4)
    copy_ends<4>(from, count, to);
  else if (count >= 2)
    copy_ends<2>(from, count, to);
  else
    *to = *from;
}

// Copies the runs' pixels, which begin at `source`; where they end.
const std::uint32_t* copy_runs(std::span<const wire::Run> runs, const std::uint32_t* source, std::uint32_t width,
                               std::uint32_t* picture) {
  for (const wire::Run& run : runs) {
    copy_run(source, run.count, picture + std::size_t{run.line} * width + run.first);
    source += run.count;
  }
  return source;
}

}  // namespace

Compositor::Compositor(std::uint32_t width, std::uint32_t height, std::uint32_t block, std::uint32_t background)
    : width_(width),
      height_(height),
      plain_(background),
      constant_(width, height, block),
      last_overwritten_(width, height, block),
      fresh_(width, height, block) {}

void Compositor::begin_interval() {
  constant_.clear();
  name_ = 0;
  last_number_.reset();
}

void Compositor::paste_constant(std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels,
                                Frame* keyframe) {
  check_runs(runs, pixels.size());
  check(keyframe == nullptr || keyframe->background == name_, "a keyframe has all CFB so far");
  if (runs.empty()) return;
  name_ = new_name();
  if (!saved_) saved_ = std::make_unique_for_overwrite<std::uint32_t[]>(std::size_t{width_} * height_);
  const std::uint32_t* source = pixels.data();
  for_rows(runs, constant_.block(), [&](std::uint32_t row, std::span<const wire::Run> part) {
    extend_background(row, part);
    const std::uint32_t* end = copy_runs(part, source, width_, saved_.get());
    if (keyframe != nullptr) copy_runs(part, source, width_, keyframe->pixels.data());
    source = end;
  });
  if (keyframe == nullptr) return;
  keyframe->background = name_;
  keyframe->constant = constant_;
}

// Blocks that the runs are the first to touch become plain background.
void Compositor::extend_background(std::uint32_t row, std::span<const wire::Run> runs) {
  for (const wire::Run& run : runs) fresh_.set_pixels(run.line, run.first, run.count);
  fresh_.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
    constant_.for_parts(row, first, last, [&](std::uint32_t from, std::uint32_t to, bool known) {
      if (known) return;
      for_lines(width_, height_, constant_.block(), row, from, to,
                [&](std::size_t at, std::size_t count) { std::fill_n(&saved_[at], count, plain_); });
    });
  });
  constant_.add_row(fresh_, row);
  fresh_.clear_row(row);
}

void Compositor::begin_frame(Frame& frame) const {
  check(frame.width == width_ && frame.height == height_, "a frame has the compositor's size");
  check(frame.overwritten.block() == constant_.block(), "a frame has the compositor's blocks");
  if (frame.plain != plain_) {
    frame.overwritten.set_all();
  } else if (frame.background != name_) {
    frame.overwritten |= frame.constant;
    frame.overwritten |= constant_;
  }
  write_back(frame);
  frame.overwritten.clear();
  frame.plain = plain_;
  frame.background = name_;
  frame.constant = constant_;
}

// Overwritten blocks show the background again.
void Compositor::write_back(Frame& frame) const {
  std::uint32_t* pixels = frame.pixels.data();
  for (std::uint32_t row = 0; row < constant_.rows(); ++row) {
    frame.overwritten.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
      constant_.for_parts(row, first, last, [&](std::uint32_t from, std::uint32_t to, bool drawn) {
        for_lines(width_, height_, constant_.block(), row, from, to, [&](std::size_t at, std::size_t count) {
          if (drawn)
            std::copy_n(&saved_[at], count, pixels + at);
          else
            std::fill_n(pixels + at, count, plain_);
        });
      });
    });
  }
}

void Compositor::paste_moving(Frame& frame, std::span<const wire::Run> runs,
                              std::span<const std::uint32_t> pixels) const {
  check_runs(runs, pixels.size());
  copy_runs(runs, pixels.data(), width_, frame.pixels.data());
  for (const wire::Run& run : runs) frame.overwritten.set_pixels(run.line, run.first, run.count);
}

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

void Compositor::check_runs(std::span<const wire::Run> runs, std::size_t pixels) const {
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
  if (counted != pixels) {
    throw Failure("a strip has " + std::to_string(pixels) + " pixels where its runs count " + std::to_string(counted),
                  "", "run host and nodes of the same version");
  }
}

}  // namespace mars::compositor
