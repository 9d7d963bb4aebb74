// Which of the frames that a person asked for are there, which are set aside, and which a next job has to bring.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "host/content/film/frame_set.h"

namespace mars::launch {

class WantedFrames {
 public:
  explicit WantedFrames(film::FrameSet asked) : asked_(std::move(asked)) {}

  // How many the person asked for: a job says it once it has the film.
  void set_count(std::uint32_t frames);
  bool counted() const { return count_.has_value(); }
  // False: it was there before.
  bool take(std::uint32_t frame) { return there_.insert(frame).second; }
  // Frames that the folder had from earlier runs.
  void add_earlier(std::uint32_t frames) { earlier_ = frames; }
  void set_aside(std::uint32_t frame) { aside_.insert(frame); }
  void take_back(std::uint32_t frame) { aside_.erase(frame); }

  std::uint32_t there() const { return earlier_ + static_cast<std::uint32_t>(there_.size()); }
  std::uint32_t of() const { return count_.value_or(0); }
  const std::set<std::uint32_t>& aside() const { return aside_; }
  // For the next job: those neither there nor aside.
  std::vector<std::uint32_t> missing() const;
  film::FrameSet next() const;

 private:
  film::FrameSet asked_;
  std::optional<std::uint32_t> count_;
  std::uint32_t earlier_ = 0;
  std::set<std::uint32_t> there_;
  std::set<std::uint32_t> aside_;
};

}  // namespace mars::launch
