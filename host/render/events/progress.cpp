#include "host/render/events/progress.h"

#include <algorithm>

namespace mars::events {

namespace {

double left_of(const Progress::Kind& kind, const Progress::Kind& other) {
  // Until one of its kind came, a frame is expected to take as long as the others did.
  const Progress::Kind& known = kind.done > 0 ? kind : other;
  return (kind.of - kind.done) * known.seconds / known.done;
}

}  // namespace

void Progress::count(FrameKind kind, std::uint32_t of_interval, double at_seconds) {
  Kind& counted = kind == FrameKind::keyframe ? keyframes : inbetweens;
  counted.seconds += std::max(0.0, at_seconds - seconds());
  ++counted.done;
  interval = of_interval;
}

std::optional<Progress::Left> Progress::left() const {
  if (forecast) return forecast;
  if (done() == 0) return std::nullopt;
  return Left{left_of(keyframes, inbetweens), left_of(inbetweens, keyframes)};
}

}  // namespace mars::events
