#include "host/render/farm/assignments.h"

namespace mars::farm {

std::optional<int> Assignments::idle_from(std::size_t first) const {
  for (std::size_t asked = 0; asked < given_.size(); ++asked) {
    const std::size_t node = (first + asked) % given_.size();
    if (given_[node].empty()) return static_cast<int>(node);
  }
  return std::nullopt;
}

std::size_t Assignments::inbetweens(int node, std::uint32_t interval) const {
  return static_cast<std::size_t>(std::ranges::count_if(of(node), [&](const Assignment& each) {
    return each.interval == interval && each.kind == wire::FrameKind::inbetween;
  }));
}

std::optional<std::uint32_t> Assignments::drawn_by(int node, std::int32_t begun) const {
  const Given& given = of(node);
  const auto frame = static_cast<std::uint32_t>(begun);
  if (begun >= 0 && std::ranges::find(given, frame, &Assignment::frame) != given.end()) return frame;
  return given.empty() ? std::nullopt : std::optional(given.front().frame);
}

}  // namespace mars::farm
