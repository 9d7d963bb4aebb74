// Which of the frames that a person asked for are there, which are set aside, and which a next job is to bring. What is
// there the folder knows best: each job reports it again (events::Resumed) and draws the others.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "host/content/film/frame_set.h"

namespace mars::launch {

class WantedFrames {
 public:
  explicit WantedFrames(film::FrameSet asked) : asked_(std::move(asked)) {}

  // How many the person asked for: the first job that has the film says it.
  void set_count(std::uint32_t frames);
  // A job found `there` frames and brought `taken`.
  void count(std::uint32_t there, std::uint32_t taken) { there_ = there + taken; }
  void set_aside(std::uint32_t frame) { aside_.insert(frame); }
  // It is there after all.
  void take_back(std::uint32_t frame);

  std::uint32_t there() const { return there_; }
  std::uint32_t of() const { return count_.value_or(0); }
  const std::set<std::uint32_t>& aside() const { return aside_; }
  // But for those aside all are there.
  bool complete() const { return count_ && there_ + aside_.size() >= *count_; }
  // For the next job: all that are not aside.
  film::FrameSet next() const;

 private:
  film::FrameSet asked_;
  std::optional<std::uint32_t> count_;
  std::uint32_t there_ = 0;
  std::set<std::uint32_t> aside_;
};

}  // namespace mars::launch
