#include "host/render/farm/assembly.h"

#include <algorithm>
#include <utility>

namespace mars::host {
namespace {

Frame* begun(Frame* frame, const Compositor& compositor) {
  if (frame == nullptr) return nullptr;
  compositor.begin_frame(*frame);
  return frame;
}

}  // namespace

Assembly::Assembly(const Unit& unit, int nodes)
    : interval_(unit.interval),
      keyframe_(unit.frames.front()),
      alone_(unit.frames.size() == 1),
      not_begun_(unit.frames.size()) {
  for (const std::uint32_t frame : unit.frames) parts_[frame].artists_left = frame == keyframe_ ? nodes : 1;
}

bool Assembly::wants(std::uint32_t frame) const {
  const auto found = parts_.find(frame);
  return found != parts_.end() && found->second.artists_left > 0;
}

void Assembly::receive(StripMessage strip) {
  const node::Strip& header = strip.header();
  Parts& parts = parts_.at(header.frame);
  if (header.last == 1) {
    --parts.artists_left;
    parts.artists.push_back(header.node);
  }
  if (parts.strips.empty()) waiting_.push_back(header.frame);
  parts.strips.push_back(std::move(strip));
}

bool Assembly::prepare(const Compositor& compositor, SinkPool& sinks) {
  const bool background_known = background_there() || parts_.at(keyframe_).picture == nullptr;
  if (prepared_ != nullptr || not_begun_ == 0 || !background_known) return false;
  prepared_ = begun(sinks.early_frame(compositor.background_name()), compositor);
  return prepared_ != nullptr;
}

bool Assembly::begin(Parts& parts, const Compositor& compositor, SinkPool& sinks) {
  const std::uint64_t background = compositor.background_name();
  if (prepared_ != nullptr)
    parts.picture = std::exchange(prepared_, nullptr);
  else if (parts.artists_left == 0)
    parts.picture = begun(sinks.free_frame(background), compositor);
  else
    parts.picture = begun(sinks.early_frame(background), compositor);
  if (parts.picture == nullptr) return false;
  --not_begun_;
  return true;
}

std::optional<Assembly::Pasted> Assembly::paste(Compositor& compositor, SinkPool& sinks, StripStore& store) {
  const auto ready = std::find_if(waiting_.begin(), waiting_.end(), [&](std::uint32_t number) {
    Parts& parts = parts_.at(number);
    return (number == keyframe_ || background_there()) &&
           (parts.picture != nullptr || begin(parts, compositor, sinks));
  });
  if (ready == waiting_.end()) return std::nullopt;
  const std::uint32_t number = *ready;
  waiting_.erase(ready);
  Parts& parts = parts_.at(number);
  for (StripMessage& strip : parts.strips) {
    paste_strip(strip, *parts.picture, compositor);
    store.give_back(strip.release());
  }
  parts.strips.clear();
  Pasted pasted{number, number == keyframe_ ? node::FrameKind::keyframe : node::FrameKind::inbetween, nullptr, {}};
  if (parts.artists_left > 0) return pasted;
  compositor.finish_frame(*parts.picture, number);
  pasted.whole = parts.picture;
  pasted.nodes = std::move(parts.artists);
  parts_.erase(number);
  return pasted;
}

void Assembly::paste_strip(const StripMessage& strip, Frame& picture, Compositor& compositor) const {
  if (alone_) {
    compositor.paste_moving(picture, strip.runs(), strip.pixels());
  } else {
    compositor.paste_constant(strip.constant_runs(), strip.constant_pixels(), &picture);
    compositor.paste_moving(picture, strip.moving_runs(), strip.moving_pixels());
  }
}

}  // namespace mars::host
