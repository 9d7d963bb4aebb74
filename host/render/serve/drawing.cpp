#include "host/render/serve/drawing.h"

#include <algorithm>

namespace mars::serve {

std::uint32_t Drawing::give(int node, Picture picture) {
  picture.nodes_left = 1;
  pictures_.emplace(++last_, picture);
  given_[static_cast<std::size_t>(node)].push_back(last_);
  return last_;
}

std::uint32_t Drawing::give_to_all(Picture picture) {
  picture.nodes_left = given_.size();
  pictures_.emplace(++last_, picture);
  for (std::deque<std::uint32_t>& given : given_) given.push_back(last_);
  return last_;
}

std::optional<int> Drawing::take_idle() {
  for (std::size_t asked = 0; asked < given_.size(); ++asked) {
    const std::size_t node = (turn_ + asked) % given_.size();
    if (!given_[node].empty()) continue;
    turn_ = node + 1;
    return static_cast<int>(node);
  }
  return std::nullopt;
}

Drawing::Keyframes Drawing::keyframes(std::uint32_t view) const {
  Keyframes keyframes;
  for (const auto& [number, picture] : pictures_)
    if (picture.kind == wire::FrameKind::keyframe) ++(picture.view == view ? keyframes.of_view : keyframes.others);
  return keyframes;
}

const Picture* Drawing::find(int node, std::uint32_t number) const {
  const std::deque<std::uint32_t>& given = given_.at(static_cast<std::size_t>(node));
  const bool draws = std::ranges::find(given, number) != given.end();
  return draws ? &pictures_.at(number) : nullptr;
}

std::optional<Picture> Drawing::end(int node, std::uint32_t number) {
  std::erase(given_.at(static_cast<std::size_t>(node)), number);
  const auto found = pictures_.find(number);
  if (--found->second.nodes_left > 0) return std::nullopt;
  const Picture picture = found->second;
  pictures_.erase(found);
  return picture;
}

std::optional<std::uint32_t> Drawing::drawn_by(int node) const {
  const std::deque<std::uint32_t>& given = given_.at(static_cast<std::size_t>(node));
  return given.empty() ? std::nullopt : std::optional(given.front());
}

}  // namespace mars::serve
