// Frames that kill the nodes which draw them: known by two different nodes that died at the same frame, each in a job
// of its own, or by one node that did so three times.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace mars::launch {

class DeadlyFrames {
 public:
  // Whether the frame is known to be deadly now.
  bool count_death(std::uint32_t frame, std::int32_t node);

 private:
  std::map<std::uint32_t, std::vector<std::int32_t>> nodes_;  // that died, by frame
};

}  // namespace mars::launch
