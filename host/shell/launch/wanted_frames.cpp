#include "host/shell/launch/wanted_frames.h"

#include <algorithm>

namespace mars::launch {

void WantedFrames::set_count(std::uint32_t frames) {
  if (!count_) count_ = frames;
}

std::vector<std::uint32_t> WantedFrames::missing() const {
  std::vector<std::uint32_t> frames = asked_.first_frames(of());
  std::erase_if(frames, [&](std::uint32_t frame) { return there_.contains(frame) || aside_.contains(frame); });
  return frames;
}

film::FrameSet WantedFrames::next() const { return count_ ? film::FrameSet(missing()) : asked_; }

}  // namespace mars::launch
