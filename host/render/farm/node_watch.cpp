#include "host/render/farm/node_watch.h"

#include <algorithm>

namespace mars::farm {
namespace {

// Seconds.
constexpr double kMostALook = 1.0;
constexpr double kLeastPatience = 30.0;

constexpr double kTimesUsual = 10.0;

}  // namespace

NodeWatch::NodeWatch(std::size_t nodes) : nodes_(nodes) {}

void NodeWatch::hear(int node) { nodes_.at(static_cast<std::size_t>(node)).silence = 0; }

void NodeWatch::hear(int node, const wire::Beat& beat) { nodes_.at(static_cast<std::size_t>(node)) = {0, beat}; }

void NodeWatch::note(const wire::PhaseTimes& times) {
  for (const auto step : {&wire::PhaseTimes::dice, &wire::PhaseTimes::map, &wire::PhaseTimes::fill,
                          &wire::PhaseTimes::scanline, &wire::PhaseTimes::shadow, &wire::PhaseTimes::compose})
    longest_.*step = std::max(longest_.*step, times.*step);
}

void NodeWatch::look(double now) {
  const double passed = looked_ < 0 ? 0 : std::clamp(now - looked_, 0.0, kMostALook);
  looked_ = now;
  for (Node& node : nodes_) node.silence += passed;
}

// In the other steps nodes wait, and beat.
double NodeWatch::patience(const wire::Beat& beat) const {
  double usual = 0;
  switch (beat.frame < 0 ? wire::Phase::credit : beat.phase) {
    case wire::Phase::dice: usual = longest_.dice; break;
    case wire::Phase::map: usual = longest_.map; break;
    case wire::Phase::fill: usual = longest_.fill; break;
    case wire::Phase::scanline: usual = longest_.scanline; break;
    case wire::Phase::shadow: usual = longest_.shadow; break;
    case wire::Phase::compose: usual = longest_.compose; break;
    default: break;
  }
  return std::max(kLeastPatience, kTimesUsual * usual);
}

template <class Beyond>
std::vector<int> NodeWatch::those(Beyond beyond) const {
  std::vector<int> found;
  for (std::size_t node = 0; node < nodes_.size(); ++node)
    if (beyond(nodes_[node])) found.push_back(static_cast<int>(node));
  return found;
}

std::vector<int> NodeWatch::silent(double seconds) const {
  return those([=](const Node& node) { return node.silence >= seconds; });
}

std::vector<int> NodeWatch::hanging() const {
  return those([this](const Node& node) { return node.silence >= patience(node.beat); });
}

}  // namespace mars::farm
