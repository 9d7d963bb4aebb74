// One value set at a frame of a channel in memory, as pose.h sets it in a film file: for who shows a change before it
// is written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "host/content/animator/pose/channel.h"

namespace mars::animator {

// A first key also makes one at frame 0, with what the part is `before`. The ease of the way there goes on.
template <typename Value>
void set_key(Channel<Value>& channel, const Value& value, std::uint32_t frame, const Value& before) {
  if (channel.empty() && frame > 0) channel.push_back({0, before, kLinear});
  const auto next = std::ranges::lower_bound(channel, frame, {}, &Key<Value>::frame);
  if (next != channel.end() && next->frame == frame) {
    next->value = value;
    return;
  }
  const bool on_the_way = next != channel.begin() && next != channel.end();
  channel.insert(next, {frame, value, on_the_way ? std::prev(next)->ease : kLinear});
}

}  // namespace mars::animator
