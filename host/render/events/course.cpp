#include "host/render/events/course.h"

#include <cmath>

namespace mars::events {
namespace {

// Of the whole, for which the forecast is trusted as if it had been measured: the first frames alone say little.
constexpr double kTrusted = 0.1;

}  // namespace

std::optional<Progress::Left> Course::left(std::size_t done, double seconds) const {
  if (done > frames_.size() || frames_.empty()) return std::nullopt;
  const double measured = done == 0 ? 0 : frames_[done - 1].seconds;
  const double trusted = kTrusted * frames_.back().seconds;
  const double ratio = (seconds + trusted) / (measured + trusted);
  double last = measured;
  Progress::Left left;
  for (std::size_t i = done; i < frames_.size(); ++i) {
    double& kind = frames_[i].kind == FrameKind::keyframe ? left.keyframes : left.inbetweens;
    kind += (frames_[i].seconds - last) * ratio;
    last = frames_[i].seconds;
  }
  if (!bounds_) return left;
  // The forecast is known as well as a measurement of `trusted` seconds; errors of means go by square roots.
  const double unknown = std::sqrt(trusted / (measured + trusted));
  left.between = {
      {left.seconds() * std::pow(bounds_->low, unknown), left.seconds() * std::pow(bounds_->high, unknown)}};
  return left;
}

}  // namespace mars::events
