// Reading of keyed values: "keys" lists whose items hold any of some channels, beside the same keys in the
// object itself for channels that no key names. A key's part is a value, or an object of a value with an ease and
// slopes of its own.
#pragma once

#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <type_traits>

#include "host/content/animator/pose/film.h"
#include "host/content/document/fields.h"
#include "node/wire/film_parts.h"

namespace mars::animator {

using wire::kMostFrames;

// The newest version of the format.
inline constexpr std::uint32_t kFilmVersion = 2;

// Refuses the element, which came with version 2, in a film that says that it is of an older one.
void require_version_2(const document::Element& element);

// One of kNamedEases, or [x1, y1, x2, y2]; `otherwise` if there is none.
Ease read_ease(const document::Fields& fields, const Ease& otherwise = kLinear);

// A change of such a value.
void read_slope(const document::Element& element, double& slope);
void read_slope(const document::Element& element, glm::dvec2& slope);
void read_slope(const document::Element& element, glm::dvec3& slope);
void read_slope(const document::Element& element, Point& slope);  // of its place in the world

// Readers of one value, as settle() and add_key() want them: of a vector; of a number, within the range of its key.
inline glm::dvec3 place_of(const document::Element& element) { return document::read_vector(element); }
inline auto number_of(const document::Fields& fields, std::string_view key) {
  return [&row = fields.key(key)](const document::Element& element) { return document::read_number(element, row); };
}

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

template <typename Value>
std::optional<Value> find_slope(const document::Fields& part, std::string_view name) {
  const auto element = part.find(name);
  if (!element) return std::nullopt;
  Value slope;
  read_slope(*element, slope);
  return slope;
}

// A part of a key, whose ease is `ease` unless it has its own. `read` reads the value.
template <typename Read>
auto read_part(const document::Element& element, std::uint32_t frame, const Ease& ease, Read read) {
  using Value = std::decay_t<decltype(read(element))>;
  // A point of an actor is an object, too.
  const bool plain =
      element.kind() != document::Kind::object || (std::is_same_v<Value, Point> && !element.find("value"));
  if (plain) return Key<Value>{frame, read(element), ease};
  require_version_2(element);
  const document::Fields part(element, keys::object("part"));
  return Key<Value>{frame, read(part.required("value")), read_ease(part, ease), find_slope<Value>(part, "in"),
                    find_slope<Value>(part, "out")};
}

// Adds the part of the key, if it is there, to the channel.
template <typename Value, typename Read>
void add_key(Channel<Value>& channel, const document::Fields& fields, std::string_view part, std::uint32_t frame,
             const Ease& ease, Read read) {
  if (const auto element = fields.find(part)) channel.push_back(read_part(*element, frame, ease, read));
}

// A channel that no key names takes the object's own value, else the table's default.
template <typename Value, typename Read>
void settle(Channel<Value>& channel, const document::Fields& fields, std::string_view key, Read read) {
  const auto element = fields.find(key);
  if (element && !channel.empty()) element->refuse("is also set by keys", "take it out here, or out of every key");
  if (channel.empty()) channel = constant(read(fields.value(key)));
}

}  // namespace mars::animator
