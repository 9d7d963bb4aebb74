// Values of one thing over a film's frames, as the compiled film keeps them: only those that differ from the one
// before.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/channel.h"
#include "node/wire/film.h"

namespace mars::film {

// What of a film is written: all of its frames, or the one at `first`, which is then frame 0.
struct WrittenFrames {
  std::uint32_t first = 0;
  std::uint32_t count = 1;
};

// Appends to a film's values and to one track of changes.
template <typename Value>
class TrackWriter {
 public:
  explicit TrackWriter(std::vector<Value>& values) : values_(values) {}

  void add(std::uint32_t frame, const Value& value) {
    if (!changes_.empty() && value == values_.back()) return;
    changes_.push_back({frame, static_cast<std::uint32_t>(values_.size())});
    values_.push_back(value);
  }

  wire::Track write(std::vector<wire::Change>& changes) const {
    if (changes.size() + changes_.size() > std::numeric_limits<std::uint32_t>::max())
      throw Failure("changes too often", "", "make the film shorter, or move fewer segments");
    const wire::Track track{static_cast<std::uint32_t>(changes.size()), static_cast<std::uint32_t>(changes_.size())};
    changes.insert(changes.end(), changes_.begin(), changes_.end());
    return track;
  }

 private:
  std::vector<Value>& values_;
  std::vector<wire::Change> changes_;
};

// Frames of a film of `frames` at which a value may differ from the frame before: 0, then up to the last key.
template <typename... Channels>
std::uint32_t frames_to_see(std::uint32_t frames, const Channels&... channels) {
  const auto last = [](const auto& channel) { return channel.size() < 2 ? 0 : channel.back().frame; };
  return std::min(frames, std::max({std::uint32_t(last(channels))...}) + 1);
}

}  // namespace mars::film
