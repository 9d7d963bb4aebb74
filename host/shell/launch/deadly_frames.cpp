#include "host/shell/launch/deadly_frames.h"

#include <algorithm>

namespace mars::launch {
namespace {

constexpr std::size_t kFramesOfOneNode = 3;

}  // namespace

bool DeadlyFrames::count_death(std::uint32_t frame, std::int32_t node) {
  std::vector<std::int32_t>& nodes = nodes_[frame];
  nodes.push_back(node);
  const bool several = std::any_of(nodes.begin(), nodes.end(), [&](std::int32_t each) { return each != node; });
  return several || nodes.size() >= kFramesOfOneNode;
}

}  // namespace mars::launch
