// Reading of keyed values: "keys" lists whose items hold any of some channels, beside the same keys in the
// object itself for channels that no key names.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "host/content/animator/channel.h"
#include "host/content/document/fields.h"
#include "node/wire/film_parts.h"

namespace mars::animator {

using wire::kMostFrames;

inline constexpr std::string_view kKeyedValueNames[] = {"value", "ease", "in", "out"};
inline constexpr document::Keys kKeyedValueKeys{"keyed_value", kKeyedValueNames};

// "linear", "in", "out", "both", "spline" or [x1, y1, x2, y2]; linear if there is none.
Ease read_ease(const document::Fields& fields);

// Of splines, by what has them.
glm::dvec3 read_slope(const document::Element& element, const glm::dvec3& of);
glm::dvec2 read_slope(const document::Element& element, const glm::dvec2& of);
double read_slope(const document::Element& element, double of);

// A part's value with an ease and slopes of its own.
bool is_keyed_value(const document::Element& element);

// Calls take(fields, frame, ease) for each item of the list, whose frames must ascend.
template <typename Take>
void read_keys(const document::Element& list, const document::Keys& keys, Take take) {
  document::require_kind(list, document::Kind::list);
  std::int64_t before = -1;
  for (const document::Element item : list) {
    const document::Fields fields(item, keys);
    const document::Element frame_element = fields.required("frame");
    const std::uint32_t frame = document::read_count(frame_element, 0, kMostFrames);
    if (frame <= before)
      frame_element.refuse("is " + std::to_string(frame) + " after " + std::to_string(before),
                           "write keys in ascending frames, one for each");
    before = frame;
    take(fields, frame, read_ease(fields));
  }
}

// One part of a key: a value, or one with its own ease and slopes.
template <typename Value, typename Read>
Key<Value> read_key(const document::Element& element, std::uint32_t frame, const Ease& ease, Read read) {
  if (!is_keyed_value(element)) return {frame, read(element), ease};
  const document::Fields fields(element, kKeyedValueKeys);
  Key<Value> key{frame, read(fields.required("value")), fields.find("ease") ? read_ease(fields) : ease};
  if (const auto in = fields.find("in")) key.in = read_slope(*in, key.value);
  if (const auto out = fields.find("out")) key.out = read_slope(*out, key.value);
  return key;
}

// Adds the value of `key`, if it is there, to the channel.
template <typename Value, typename Read>
void add_key(Channel<Value>& channel, const document::Fields& fields, std::string_view key, std::uint32_t frame,
             const Ease& ease, Read read) {
  if (const auto element = fields.find(key)) channel.push_back(read_key<Value>(*element, frame, ease, read));
}

// A channel that no key names takes the object's own value, else `otherwise`.
template <typename Value, typename Read>
void settle(Channel<Value>& channel, const document::Fields& fields, std::string_view key, const Value& otherwise,
            Read read) {
  const auto element = fields.find(key);
  if (element && !channel.empty()) element->refuse("is also set by keys", "take it out here, or out of every key");
  if (channel.empty()) channel = constant(element ? read(*element) : otherwise);
}

}  // namespace mars::animator
