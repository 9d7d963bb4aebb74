#include "host/render/events/course.h"

namespace mars::events {
namespace {

// Of the whole, for which the forecast is trusted as if it had been measured: the first frames alone say little.
constexpr double kTrusted = 0.1;

}  // namespace

std::optional<Progress::Left> Course::left(std::size_t done, double seconds) const {
  if (done > frames_.size() || frames_.empty()) return std::nullopt;
  double last = done == 0 ? 0 : frames_[done - 1].seconds;
  const double trusted = kTrusted * frames_.back().seconds;
  const double ratio = (seconds + trusted) / (last + trusted);
  Progress::Left left{0, 0};
  for (std::size_t i = done; i < frames_.size(); ++i) {
    double& kind = frames_[i].kind == FrameKind::keyframe ? left.keyframes : left.inbetweens;
    kind += (frames_[i].seconds - last) * ratio;
    last = frames_[i].seconds;
  }
  return left;
}

}  // namespace mars::events
