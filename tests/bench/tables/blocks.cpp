// What blocks of the host's flags cost by their side (thesis 4.10).
//
//   bench-blocks SIDE ... -- MASK.png ...
//
// Masks are pictures of an interval in which moving parts have the colour kMoving and nothing is shaded so elsewhere:
// the first is the keyframe's. Prints for each side, of an inbetween on average: the side, blocks flagged, pixels
// restored, microseconds for flags alone, and for all that the compositor does. The best of many rounds counts.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/failure/explain.h"
#include "host/images/picture_file.h"
#include "host/render/compositor/compositor.h"

namespace mars::bench {
namespace {

using compositor::BlockFlags;
using images::Image;

constexpr std::uint32_t kMoving = 0xff00ff;
constexpr int kRounds = 20;

// Pixels of one frame as a node sends them.
struct Pixels {
  std::vector<wire::Run> runs;
  std::vector<std::uint32_t> colors;
};

template <typename Wanted>
Pixels pixels_where(const Image& image, Wanted wanted) {
  Pixels out;
  for (std::uint32_t line = 0; line < image.height; ++line)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::uint32_t color = image.pixels[std::size_t{line} * image.width + x];
      if (!wanted(color)) continue;
      const bool joins =
          !out.runs.empty() && out.runs.back().line == line && out.runs.back().first + out.runs.back().count == x;
      if (joins)
        ++out.runs.back().count;
      else
        out.runs.push_back({line, static_cast<std::uint16_t>(x), 1});
      out.colors.push_back(color);
    }
  return out;
}

struct Interval {
  std::uint32_t width, height;
  std::uint32_t plain;
  Pixels constant;
  std::vector<Pixels> moving;  // of each frame
};

Interval read_interval(std::span<const std::string> files) {
  if (files.size() < 2) throw std::runtime_error("a keyframe's mask and one of an inbetween are needed");
  Interval interval{};
  for (const std::string& file : files) {
    const Image image = images::read_picture(images::PictureFormat::png, file);
    if (interval.moving.empty()) {
      interval.width = image.width;
      interval.height = image.height;
      interval.plain = image.pixels.front();
      interval.constant =
          pixels_where(image, [&](std::uint32_t color) { return color != interval.plain && color != kMoving; });
    }
    interval.moving.push_back(pixels_where(image, [](std::uint32_t color) { return color == kMoving; }));
  }
  return interval;
}

template <typename Work>
double microseconds(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

// The host's whole work on the inbetweens.
double composing(const Interval& interval, std::uint32_t side) {
  compositor::Compositor host(interval.width, interval.height, side);
  compositor::Frame frame(interval.width, interval.height, side, interval.plain);
  host.begin_interval(interval.plain);
  host.begin_frame(frame);
  host.paste_constant(interval.constant.runs, interval.constant.colors, &frame);
  host.finish_frame(frame, 0);
  return microseconds([&] {
    for (std::uint32_t k = 1; k < interval.moving.size(); ++k) {
      host.begin_frame(frame);
      host.paste_moving(frame, interval.moving[k].runs, interval.moving[k].colors);
      host.finish_frame(frame, k);
    }
  });
}

// Setting the flags of each inbetween, and looking for those of the one before.
struct Flags {
  double microseconds;
  std::uint64_t flagged;
};
Flags flagging(const Interval& interval, std::uint32_t side) {
  BlockFlags now(interval.width, interval.height, side), before = now;
  Flags out{};
  std::uint64_t found = 0;
  out.microseconds = microseconds([&] {
    for (std::size_t k = 1; k < interval.moving.size(); ++k) {
      std::swap(now, before);
      now.clear();
      for (const wire::Run& run : interval.moving[k].runs) now.set_pixels(run.line, run.first, run.count);
      for (std::uint32_t row = 0; row < before.rows(); ++row)
        before.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) { found += last - first; });
    }
  });
  out.flagged = found + now.count();
  return out;
}

// Whether the pixels cover a whole block.
class Cover {
 public:
  Cover(const Interval& interval, const Pixels& pixels)
      : width_(interval.width), height_(interval.height), covered_(std::size_t{width_} * height_) {
    for (const wire::Run& run : pixels.runs)
      std::fill_n(&covered_[std::size_t{run.line} * width_ + run.first], run.count, 1);
  }
  // The block's pixels, none if all of them are covered.
  std::uint64_t pixels_unless_filled(std::uint32_t column, std::uint32_t row, std::uint32_t side) const {
    const std::uint32_t right = std::min(width_, (column + 1) * side), bottom = std::min(height_, (row + 1) * side);
    bool filled = true;
    for (std::uint32_t y = row * side; y < bottom; ++y)
      for (std::uint32_t x = column * side; x < right; ++x) filled = filled && covered_[std::size_t{y} * width_ + x];
    return filled ? 0 : std::uint64_t{right - column * side} * (bottom - row * side);
  }

 private:
  std::uint32_t width_, height_;
  std::vector<char> covered_;
};

std::uint64_t restored_pixels(const Interval& interval, std::uint32_t side) {
  std::uint64_t restored = 0;
  for (std::size_t k = 1; k < interval.moving.size(); ++k) {
    BlockFlags before(interval.width, interval.height, side);
    for (const wire::Run& run : interval.moving[k - 1].runs) before.set_pixels(run.line, run.first, run.count);
    const Cover cover(interval, interval.moving[k]);
    for (std::uint32_t row = 0; row < before.rows(); ++row)
      before.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
        for (; first < last; ++first) restored += cover.pixels_unless_filled(first, row, side);
      });
  }
  return restored;
}

void measure(const Interval& interval, std::span<const std::uint32_t> sides) {
  struct Best {
    double all = std::numeric_limits<double>::infinity();
    double flags = std::numeric_limits<double>::infinity();
    std::uint64_t flagged = 0;
  };
  std::vector<Best> bests(sides.size());
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t k = 0; k < sides.size(); ++k) {
      bests[k].all = std::min(bests[k].all, composing(interval, sides[k]));
      const Flags flags = flagging(interval, sides[k]);
      bests[k].flags = std::min(bests[k].flags, flags.microseconds);
      bests[k].flagged = flags.flagged;
    }
  const auto frames = static_cast<double>(interval.moving.size() - 1);
  for (std::size_t k = 0; k < sides.size(); ++k)
    std::cout << sides[k] << ' ' << static_cast<double>(bests[k].flagged) / frames << ' '
              << static_cast<double>(restored_pixels(interval, sides[k])) / frames << ' ' << bests[k].flags / frames
              << ' ' << bests[k].all / frames << '\n';
}

void run(std::span<const std::string> words) {
  const auto dashes = std::find(words.begin(), words.end(), "--");
  if (dashes == words.begin() || dashes == words.end())
    throw std::runtime_error("usage: bench-blocks SIDE ... -- MASK.png ...");
  std::vector<std::uint32_t> sides;
  for (auto word = words.begin(); word != dashes; ++word)
    sides.push_back(static_cast<std::uint32_t>(std::stoul(*word)));
  measure(read_interval({dashes + 1, words.end()}), sides);
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  try {
    mars::bench::run(std::vector<std::string>(argv + 1, argv + argc));
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "bench-blocks: " << mars::reason_of(failure) << '\n';
    return 1;
  }
}
