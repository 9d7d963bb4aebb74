#include "host/shell/batch/array_parts.h"

#include <algorithm>
#include <cstdint>

namespace mars::batch {
namespace {

constexpr double kLonger = 1.1;  // than it must be, if that saves a keyframe
constexpr int kHalvings = 50;

// Frames in a row, by their places, that are cut into parts.
class Row {
 public:
  Row(std::span<const farm::Task> tasks, std::span<const farm::RoughWork> works) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      begins_.push_back(frames_.size());
      for (const std::uint32_t frame : tasks[i].frames) add(frame, works[i], frames_.size() == begins_.back());
    }
  }

  std::size_t size() const { return frames_.size(); }
  std::span<const std::uint32_t> frames(std::size_t first, std::size_t end) const {
    return std::span(frames_).subspan(first, end - first);
  }
  double work() const { return before_.back(); }  // of one job
  double work(std::size_t first, std::size_t end) const { return before_[end] - before_[first] + more_[first]; }

  // Where the part that begins at `first` ends: at the beginning of an interval, or as late as the least work of the
  // longest part allows, if the rest then fits into the parts that are left.
  std::size_t end_of(std::size_t first, std::size_t parts_left, double least) const {
    const double most = kLonger * least;
    const std::size_t last = end_within(first, most);
    if (last == size()) return last;
    for (const std::size_t end : {last_begin(last), end_within(first, least)})
      if (end > first && parts_within(end, most) < parts_left) return end;
    return last;
  }

  // Work of the longest of `parts` parts, found by halving.
  double least_work(std::size_t parts) const {
    double too_little = 0, enough = work();
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (too_little + enough) / 2;
      (parts_within(0, middle) <= parts ? enough : too_little) = middle;
    }
    return enough;
  }

 private:
  void add(std::uint32_t frame, const farm::RoughWork& work, bool keyframe) {
    frames_.push_back(frame);
    before_.push_back(before_.back() + (keyframe ? work.keyframe : work.inbetween));
    more_.push_back(keyframe ? 0 : work.keyframe - work.inbetween);
  }

  // Of the longest part from `first` that takes no more; it has one frame at least.
  std::size_t end_within(std::size_t first, double most) const {
    const auto from = before_.begin() + static_cast<std::ptrdiff_t>(first) + 2;
    const auto over = std::upper_bound(from, before_.end(), before_[first] + most - more_[first]);
    return static_cast<std::size_t>(over - before_.begin()) - 1;
  }

  // More than all frames where a frame alone takes more.
  std::size_t parts_within(std::size_t first, double most) const {
    std::size_t parts = 0;
    for (std::size_t end = first; first < size(); first = end, ++parts) {
      end = end_within(first, most);
      if (work(first, end) > most) return size() + 1;
    }
    return parts;
  }

  std::size_t last_begin(std::size_t until) const { return *(std::ranges::upper_bound(begins_, until) - 1); }

  std::vector<std::uint32_t> frames_;
  std::vector<std::size_t> begins_;  // of intervals
  std::vector<double> before_{0};    // work of all frames before each, and of all
  std::vector<double> more_;         // work of each as the first of a part
};

}  // namespace

ArrayParts array_parts(std::span<const farm::Task> tasks, std::span<const farm::RoughWork> works, std::size_t count) {
  const Row row(tasks, works);
  const double least = row.least_work(count);
  ArrayParts parts;
  double work = 0;
  for (std::size_t first = 0, end = 0; first < row.size(); first = end) {
    end = row.end_of(first, count - parts.frames.size(), least);
    parts.frames.emplace_back(row.frames(first, end));
    work += row.work(first, end);
  }
  parts.more_work = work / row.work() - 1;
  return parts;
}

}  // namespace mars::batch
