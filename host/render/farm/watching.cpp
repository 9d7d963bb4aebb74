#include "host/render/farm/watching.h"

#include <algorithm>

#include "hal/nx/nx_messages.h"

namespace mars::farm {

Watching::Watching(watch::Watch* watch, std::span<const collectives::Group> groups) : watch_(watch), groups_(groups) {
  if (watch_ == nullptr) return;
  listener_ = [this](const StripMessage& strip, const compositor::Compositor& compositor,
                     const compositor::Frame& frame) { paste(strip, compositor, frame); };
}

void Watching::begin(const watch::Shape& shape, std::span<const wire::Hello> nodes) {
  if (watch_ == nullptr) return;
  start_ = dclock();
  watch_->begin(shape, nodes);
}

void Watching::receive(const wire::Strip& header) {
  if (watch_ != nullptr) watch_->receive(header, dclock() - start_);
}

void Watching::follow(std::span<const GroupWork> groups) {
  if (watch_ == nullptr) return;
  const auto busy = std::ranges::find_if(groups, [](const GroupWork& group) { return group.tasks() > 0; });
  const auto first = static_cast<std::uint32_t>(busy - groups.begin());
  if (busy == groups.end() || first == followed_) return;
  followed_ = first;
  watch_->follow(first);
}

void Watching::paste(const StripMessage& strip, const compositor::Compositor& compositor,
                     const compositor::Frame& frame) {
  watch_->paste(group_of(strip.header().node),
                {strip.header(), strip.constant_runs(), strip.moving_runs(), strip.edge_boxes()}, compositor, frame,
                dclock() - start_);
}

void Watching::compose(watch::WholeFrame frame) {
  if (watch_ == nullptr) return;
  frame.group = group_of(frame.first_node);
  watch_->compose(frame);
}

std::uint32_t Watching::group_of(std::int32_t node) const {
  const auto has = [node](const collectives::Group& group) {
    return node >= group.first && node < group.first + group.count;
  };
  return static_cast<std::uint32_t>(std::ranges::find_if(groups_, has) - groups_.begin());
}

}  // namespace mars::farm
