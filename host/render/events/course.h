// When frames are expected to come, by a forecast; and how long the rest takes, by that and by how the run went so far.
#pragma once

#include <vector>

#include "host/render/events/progress.h"

namespace mars::events {

struct ExpectedFrame {
  double seconds;  // after the start
  FrameKind kind;
};

class Course {
 public:
  Course() = default;
  // In the order in which they come.
  explicit Course(std::vector<ExpectedFrame> frames) : frames_(std::move(frames)) {}

  // Seconds until all are there, when the first `done` of them took `seconds`: as the forecast says, longer or shorter
  // by what these took beside it. Nothing without a forecast.
  std::optional<Progress::Left> left(std::size_t done, double seconds) const;

 private:
  std::vector<ExpectedFrame> frames_;
};

}  // namespace mars::events
