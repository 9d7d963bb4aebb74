// One thing that changes over a film's frames: a place, a pose of a joint, a field of view. Keys in ascending
// frames; before the first and after the last it holds. A key's ease rules the way to the next key.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/content/animator/ease.h"

namespace mars::animator {

template <typename Value>
struct Key {
  std::uint32_t frame;
  Value value;
  Ease ease = kLinear;
};

template <typename Value>
using Channel = std::vector<Key<Value>>;

template <typename Value>
Channel<Value> constant(const Value& value) {
  return {{0, value, kLinear}};
}

// Where a frame lies: `part` of the way from one key to another; from == to, part 0 on a key and where it
// holds.
struct Stretch {
  std::size_t from;
  std::size_t to;
  double part;
};

// `channel` has at least one key.
template <typename Value>
Stretch stretch_at(const Channel<Value>& channel, std::uint32_t frame) {
  const auto later = std::upper_bound(channel.begin(), channel.end(), frame,
                                      [](std::uint32_t f, const Key<Value>& key) { return f < key.frame; });
  const auto next = static_cast<std::size_t>(later - channel.begin());
  if (next == 0) return {0, 0, 0};
  const Key<Value>& from = channel[next - 1];
  if (next == channel.size() || from.frame == frame) return {next - 1, next - 1, 0};
  const double time = double(frame - from.frame) / double(later->frame - from.frame);
  return {next - 1, next, eased(from.ease, time)};
}

// Numbers, places and colours go straight from key to key.
template <typename Value>
Value value_at(const Channel<Value>& channel, std::uint32_t frame) {
  const Stretch stretch = stretch_at(channel, frame);
  const Value& from = channel[stretch.from].value;
  if (stretch.from == stretch.to) return from;
  return from + stretch.part * (channel[stretch.to].value - from);
}

}  // namespace mars::animator
