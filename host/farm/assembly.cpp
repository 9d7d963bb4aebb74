#include "host/farm/assembly.h"

namespace mars::host {

Assembly::Assembly(const Unit& unit, const hal::Cube& cube, Compositor compositor)
    : cube_(cube),
      keyframe_(unit.frames.front()),
      compositor_(std::move(compositor)),
      background_parts_(cube.count),
      frames_left_(unit.frames.size()) {
  for (const std::uint32_t frame : unit.frames) parts_[frame].artists_left = frame == keyframe_ ? cube.count : 1;
  compositor_.begin_interval();
}

bool Assembly::wants(std::uint32_t frame) const {
  const auto found = parts_.find(frame);
  return found != parts_.end() && found->second.artists_left > 0;
}

void Assembly::receive(StripMessage strip) {
  const node::Strip header = strip.header();
  Parts& parts = parts_.at(header.frame);
  if (header.frame == keyframe_) compositor_.paste_constant(strip.constant_runs(), strip.constant_pixels());
  parts.strips.push_back(std::move(strip));
  if (header.last == 0) return;
  if (header.frame == keyframe_) --background_parts_;
  // The keyframe goes first, for it is what was waited for.
  if (--parts.artists_left == 0) {
    if (header.frame == keyframe_)
      whole_.push_front(header.frame);
    else
      whole_.push_back(header.frame);
  }
}

Assembly::Composed Assembly::compose(Frame& frame) {
  const std::uint32_t number = whole_.front();
  whole_.pop_front();
  Parts parts = std::move(parts_[number]);
  Composed out{number, number == keyframe_ ? node::FrameKind::keyframe : node::FrameKind::inbetween, {}, {}};
  compositor_.begin_frame(frame, number);
  for (StripMessage& strip : parts.strips) {
    compositor_.paste_moving(frame, strip.moving_runs(), strip.moving_pixels());
    if (strip.header().last == 1) out.nodes.push_back(strip.header().node);
    out.bytes.push_back(strip.release());
  }
  compositor_.finish_frame(frame);
  parts_.erase(number);
  --frames_left_;
  return out;
}

}  // namespace mars::host
