// When frames are expected to come, by a forecast; and how long the rest takes, by that and by how the run went so far.
#pragma once

#include <optional>
#include <vector>

#include "host/render/events/progress.h"

namespace mars::events {

struct ExpectedFrame {
  double seconds;  // after the start
  FrameKind kind;
};

// Between which a rendering's time over its forecast lies, nine times of ten.
struct RatioBounds {
  double low;
  double high;
};

class Course {
 public:
  Course() = default;
  // In the order in which they come; no bounds: it is not known how far off they are.
  explicit Course(std::vector<ExpectedFrame> frames, std::optional<RatioBounds> bounds = std::nullopt)
      : frames_(std::move(frames)), bounds_(bounds) {}

  // Seconds until all are there, when the first `done` of them took `seconds`: as the forecast says, longer or shorter
  // by what these took beside it, which also narrows the bounds. Nothing without a forecast.
  std::optional<Progress::Left> left(std::size_t done, double seconds) const;

 private:
  std::vector<ExpectedFrame> frames_;
  std::optional<RatioBounds> bounds_;
};

}  // namespace mars::events
