// One thing that changes over a film's frames: a place, a pose of a joint, a field of view. Keys in ascending
// frames; before the first and after the last it holds. A key's ease rules the way to the next key: straight on by its
// timing, or by a spline, a cubic curve with a slope at each of the two keys; or nothing moves until the next key.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/content/animator/pose/ease.h"

namespace mars::animator {

template <typename Value>
struct Key {
  std::uint32_t frame;
  Value value;
  Ease ease = kLinear;
  // Change a frame with which splines reach the key and leave it; where none is given, slope_at().
  std::optional<Value> in{}, out{};
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
  if (next == channel.size() || from.frame == frame || from.ease.hold) return {next - 1, next - 1, 0};
  const double time = double(frame - from.frame) / double(later->frame - from.frame);
  return {next - 1, next, eased(from.ease, time)};
}

// Of a spline at a key that has no slope of its own: from the key before to the key after (Catmull and Rom 1974, for
// keys that are not evenly spaced); at the first and the last key, and where the value jumps, to its only neighbour.
template <typename Value>
Value slope_at(const Channel<Value>& channel, std::size_t key) {
  const bool begins = key == 0 || channel[key - 1].ease.hold,
             ends = key + 1 == channel.size() || channel[key].ease.hold;
  const Key<Value>& before = channel[begins ? key : key - 1];
  const Key<Value>& after = channel[ends ? key : key + 1];
  if (before.frame == after.frame) return before.value - before.value;
  return (1.0 / double(after.frame - before.frame)) * (after.value - before.value);
}

// Hermite's cubic between the two keys.
template <typename Value>
Value spline_at(const Channel<Value>& channel, const Stretch& stretch) {
  const Key<Value>& from = channel[stretch.from];
  const Key<Value>& to = channel[stretch.to];
  const double t = stretch.part, frames = double(to.frame - from.frame);
  const Value leave = from.out ? *from.out : slope_at(channel, stretch.from);
  const Value reach = to.in ? *to.in : slope_at(channel, stretch.to);
  return from.value + ((3 - 2 * t) * t * t) * (to.value - from.value) + (((t - 2) * t + 1) * t * frames) * leave +
         ((t - 1) * t * t * frames) * reach;
}

// Its change a frame there.
template <typename Value>
Value spline_slope_at(const Channel<Value>& channel, const Stretch& stretch) {
  const Key<Value>& from = channel[stretch.from];
  const Key<Value>& to = channel[stretch.to];
  const double t = stretch.part, frames = double(to.frame - from.frame);
  const Value leave = from.out ? *from.out : slope_at(channel, stretch.from);
  const Value reach = to.in ? *to.in : slope_at(channel, stretch.to);
  return (6 * t * (1 - t) / frames) * (to.value - from.value) + ((3 * t - 4) * t + 1) * leave +
         ((3 * t - 2) * t) * reach;
}

// Whether anything changes from the key to the next: a spline may leave a value and come back to it.
template <typename Value>
bool moves_after(const Channel<Value>& channel, std::size_t key) {
  if (key + 1 >= channel.size()) return false;
  const Key<Value>&from = channel[key], &to = channel[key + 1];
  if (from.value != to.value) return true;
  if (!from.ease.spline) return false;
  const Value still = from.value - from.value;
  return (from.out ? *from.out : slope_at(channel, key)) != still ||
         (to.in ? *to.in : slope_at(channel, key + 1)) != still;
}

// Numbers, places and colours.
template <typename Value>
Value value_at(const Channel<Value>& channel, std::uint32_t frame) {
  const Stretch stretch = stretch_at(channel, frame);
  const Value& from = channel[stretch.from].value;
  if (stretch.from == stretch.to) return from;
  if (channel[stretch.from].ease.spline) return spline_at(channel, stretch);
  return from + stretch.part * (channel[stretch.to].value - from);
}

}  // namespace mars::animator
