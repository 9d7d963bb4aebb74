#include "host/compositor/compositor.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "hal/failure.h"

namespace mars::host {

namespace {

// Frames outlive compositors and pass between them, so no two backgrounds of a process share a name.
std::uint64_t new_name() {
  static std::atomic<std::uint64_t> names{0};
  return ++names;
}

void write_back(const BlockFlags& flags, std::uint32_t width, std::uint32_t height,
                const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
  const std::uint32_t block = flags.block();
  for (std::uint32_t row = 0; row < flags.rows(); ++row) {
    flags.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
      const std::size_t left = std::size_t{first} * block;
      const std::size_t right = std::min<std::size_t>(width, std::size_t{last} * block);
      const std::size_t top = std::size_t{row} * block;
      const std::size_t bottom = std::min<std::size_t>(height, top + block);
      for (std::size_t line = top; line < bottom; ++line) {
        const std::size_t at = line * width + left;
        std::copy_n(&from[at], right - left, &to[at]);
      }
    });
  }
}

}  // namespace

Compositor::Compositor(std::uint32_t width, std::uint32_t height, std::uint32_t block,
                       std::uint32_t background)
    : width_(width),
      height_(height),
      plain_(background),
      saved_(std::size_t{width} * height, background),
      plain_name_(new_name()),
      name_(plain_name_),
      last_overwritten_(width, height, block) {}

void Compositor::begin_interval() {
  if (name_ != plain_name_) std::fill(saved_.begin(), saved_.end(), plain_);
  name_ = plain_name_;
  last_number_.reset();
}

void Compositor::paste_constant(std::span<const node::Run> runs, std::span<const std::uint32_t> pixels) {
  check_runs(runs, pixels.size());
  if (runs.empty()) return;
  name_ = new_name();
  const std::uint32_t* source = pixels.data();
  for (const node::Run& run : runs) {
    std::copy_n(source, run.count, &saved_[std::size_t{run.line} * width_ + run.first]);
    source += run.count;
  }
}

void Compositor::begin_frame(Frame& frame, std::uint32_t number) const {
  check(frame.width == width_ && frame.height == height_, "a frame has the compositor's size");
  check(frame.overwritten.block() == last_overwritten_.block(), "a frame has the compositor's blocks");
  if (frame.background == name_) {
    write_back(frame.overwritten, width_, height_, saved_, frame.pixels);
  } else {
    std::copy(saved_.begin(), saved_.end(), frame.pixels.begin());
  }
  frame.background = name_;
  frame.number = number;
  frame.overwritten.clear();
}

void Compositor::paste_moving(Frame& frame, std::span<const node::Run> runs,
                              std::span<const std::uint32_t> pixels) const {
  check_runs(runs, pixels.size());
  const std::uint32_t* source = pixels.data();
  for (const node::Run& run : runs) {
    std::copy_n(source, run.count, &frame.pixels[std::size_t{run.line} * width_ + run.first]);
    frame.overwritten.set_pixels(run.line, run.first, run.count);
    source += run.count;
  }
}

void Compositor::finish_frame(Frame& frame) {
  frame.changed_since = last_number_;
  if (last_number_) {
    frame.changed = frame.overwritten;
    frame.changed |= last_overwritten_;
  } else {
    frame.changed.set_all();
  }
  last_overwritten_ = frame.overwritten;
  last_number_ = frame.number;
}

void Compositor::check_runs(std::span<const node::Run> runs, std::size_t pixels) const {
  std::size_t counted = 0;
  for (const node::Run& run : runs) {
    if (run.count == 0 || run.line >= height_ || std::uint32_t{run.first} + run.count > width_) {
      throw Failure("a strip draws outside the picture: " + std::to_string(run.count) +
                        " pixels from column " + std::to_string(run.first) + " of line " +
                        std::to_string(run.line),
                    "a picture of " + std::to_string(width_) + "x" + std::to_string(height_) + " pixels",
                    "run host and nodes of the same version");
    }
    counted += run.count;
  }
  if (counted != pixels) {
    throw Failure(
        "a strip has " + std::to_string(pixels) + " pixels where its runs count " + std::to_string(counted),
        "", "run host and nodes of the same version");
  }
}

}  // namespace mars::host
