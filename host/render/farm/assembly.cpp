#include "host/render/farm/assembly.h"

#include <algorithm>
#include <utility>

#include "node/color/encoding.h"

namespace mars::farm {
namespace {

compositor::Frame* begun(compositor::Frame* frame, const compositor::Compositor& compositor) {
  if (frame == nullptr) return nullptr;
  compositor.begin_frame(*frame);
  return frame;
}

}  // namespace

std::uint64_t background_pixel(const wire::PackedFilm& film, const wire::Interval& interval, wire::PixelFormat format) {
  const wire::FilmSettings& settings = film.settings();
  const auto encoding = color::encoding_of(settings, film.camera_at(interval.first_frame), format);
  return color::background_pixel(encoding, settings.background.data());
}

void paste_strip(const StripMessage& strip, compositor::Frame& picture, compositor::Compositor& compositor,
                 bool alone) {
  if (alone) return compositor.paste_moving(picture, strip.runs(), strip.pixels());
  compositor.paste_constant(strip.constant_runs(), strip.constant_pixels(), &picture);
  compositor.paste_moving(picture, strip.moving_runs(), strip.moving_pixels());
}

Assembly::Assembly(const Task& task, const collectives::Group& group, const Division& division,
                   Assignments& assignments)
    : group_(group),
      teams_(division.teams),
      interval_(task.interval),
      keyframe_(task.frames.front()),
      alone_(task.frames.size() == 1),
      not_begun_(task.frames.size()) {
  for (const std::uint32_t frame : task.frames) parts_[frame] = {};
  Parts& keyframe = parts_[keyframe_];
  keyframe.nodes = {group.first, division.contributors};
  keyframe.nodes_left = division.contributors;
  for (int node = group.first; node < group.first + division.contributors; ++node)
    assignments.give(node, {keyframe_, interval_, wire::FrameKind::keyframe});
}

void Assembly::give(const Task& task, const Portion& portion, Assignments& assignments) {
  for (std::size_t k = portion.first; k < portion.first + portion.count; ++k) {
    const std::uint32_t frame = task.frames[1 + k];
    Parts& parts = parts_.at(frame);
    parts.nodes = wire::team_of_inbetween(task.first_inbetween + k, group_, teams_, portion.cycle);
    parts.nodes_left = parts.nodes.count;
    for (int node = parts.nodes.first; node < parts.nodes.first + parts.nodes.count; ++node)
      assignments.give(node, {frame, interval_, wire::FrameKind::inbetween});
  }
}

bool Assembly::awaits_file(std::uint32_t frame) const {
  const auto found = parts_.find(frame);
  return found != parts_.end() && found->second.nodes.count > 0 && !found->second.is_written;
}

std::optional<Assembly::Pasted> Assembly::note_drawn(std::uint32_t frame) {
  --parts_.at(frame).nodes_left;
  return finish_written(frame);
}

std::optional<Assembly::Pasted> Assembly::note_written(std::uint32_t frame) {
  parts_.at(frame).is_written = true;
  return finish_written(frame);
}

std::optional<Assembly::Pasted> Assembly::finish_written(std::uint32_t number) {
  const Parts& parts = parts_.at(number);
  if (!parts.is_written || parts.nodes_left > 0) return std::nullopt;
  const Pasted written = describe(number, parts);
  parts_.erase(number);
  return written;
}

void Assembly::receive(StripMessage strip) {
  const wire::Strip& header = strip.header();
  Parts& parts = parts_.at(header.frame);
  if (header.last == 1) --parts.nodes_left;
  if (parts.strips.empty()) waiting_.push_back(header.frame);
  parts.strips.push_back(std::move(strip));
}

bool Assembly::prepare(const compositor::Compositor& compositor, sinks::SinkPool& sinks) {
  const bool background_known = background_there() || parts_.at(keyframe_).picture == nullptr;
  if (prepared_ != nullptr || not_begun_ == 0 || !background_known) return false;
  prepared_ = begun(sinks.early_frame(compositor.background_name()), compositor);
  return prepared_ != nullptr;
}

bool Assembly::begin(Parts& parts, const compositor::Compositor& compositor, sinks::SinkPool& sinks) {
  const std::uint64_t background = compositor.background_name();
  if (prepared_ != nullptr)
    parts.picture = std::exchange(prepared_, nullptr);
  else if (parts.nodes_left == 0)
    parts.picture = begun(sinks.free_frame(background), compositor);
  else
    parts.picture = begun(sinks.early_frame(background), compositor);
  if (parts.picture == nullptr) return false;
  --not_begun_;
  return true;
}

Assembly::Pasted Assembly::describe(std::uint32_t number, const Parts& parts) const {
  const auto kind = number == keyframe_ ? wire::FrameKind::keyframe : wire::FrameKind::inbetween;
  return {number, kind, nullptr, {}, parts.nodes.first, parts.nodes.count};
}

std::optional<Assembly::Pasted> Assembly::paste(compositor::Compositor& compositor, sinks::SinkPool& sinks,
                                                StripStore& store, const PasteListener& listener) {
  const auto ready = std::find_if(waiting_.begin(), waiting_.end(), [&](std::uint32_t number) {
    Parts& parts = parts_.at(number);
    return (number == keyframe_ || background_there()) && (parts.picture != nullptr || begin(parts, compositor, sinks));
  });
  if (ready == waiting_.end()) return std::nullopt;
  const std::uint32_t number = *ready;
  waiting_.erase(ready);
  Parts& parts = parts_.at(number);
  Pasted pasted = describe(number, parts);
  for (StripMessage& strip : parts.strips) {
    paste_strip(strip, *parts.picture, compositor, alone_);
    if (listener) listener(strip, compositor, *parts.picture);
    pasted.free.push_back(strip.slot());
    store.give_back(strip.release());
  }
  parts.strips.clear();
  if (parts.nodes_left > 0) return pasted;
  compositor.finish_frame(*parts.picture, number);
  if (listener || !sinks.restores()) compositor.restore(*parts.picture);
  if (!sinks.restores()) parts.picture->shown.reset();
  pasted.whole = parts.picture;
  parts_.erase(number);
  return pasted;
}

}  // namespace mars::farm
