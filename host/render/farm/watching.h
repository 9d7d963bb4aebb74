// The farm's part in a rendering that is watched (host/render/watch). Where nobody watches, every call does nothing.
#pragma once

#include <cstdint>
#include <span>

#include "host/render/farm/group_work.h"
#include "host/render/watch/watch.h"

namespace mars::farm {

class Watching {
 public:
  // `watch` may be nullptr.
  Watching(watch::Watch* watch, std::span<const collectives::Group> groups);

  // All nodes are there, and the first command goes out now.
  void begin(const watch::Shape& shape, std::span<const wire::Hello> nodes);
  // A strip has come.
  void receive(const wire::Strip& header);
  // Before something is composed: the picture of the first group that has work is shown.
  void follow(std::span<const GroupWork> groups);
  // For what is pasted; none where nobody watches.
  const PasteListener& listener() const { return listener_; }
  // Before the sinks have it; its group is set here.
  void compose(watch::WholeFrame frame);

 private:
  std::uint32_t group_of(std::int32_t node) const;
  void paste(const StripMessage& strip, const compositor::Compositor& compositor, const compositor::Frame& frame);

  watch::Watch* const watch_;
  const std::span<const collectives::Group> groups_;
  PasteListener listener_;
  double start_ = 0;
  std::uint32_t followed_ = 0;
};

}  // namespace mars::farm
