#include "host/shell/launch/wanted_frames.h"

#include <vector>

namespace mars::launch {

void WantedFrames::set_count(std::uint32_t frames) {
  if (!count_) count_ = frames;
}

void WantedFrames::take_back(std::uint32_t frame) {
  aside_.erase(frame);
  ++there_;
}

film::FrameSet WantedFrames::next() const {
  if (aside_.empty()) return asked_;
  std::vector<std::uint32_t> frames = asked_.first_frames(of());
  std::erase_if(frames, [&](std::uint32_t frame) { return aside_.contains(frame); });
  return film::FrameSet(frames);
}

}  // namespace mars::launch
