#include "host/animator/pose.h"

#include <charconv>
#include <set>

#include "hal/failure.h"
#include "host/animator/angles.h"
#include "host/animator/edit.h"
#include "host/animator/tracks.h"
#include "host/animator/written.h"
#include "host/document/fields.h"

namespace mars::host {
namespace {

[[noreturn]] void refuse_wish(const std::string& text) {
  throw Failure("is no wish", "'" + text + "'", "write it like elbow.y=90, elbow=0,90,0, place=2,0,0 or turn.z=45");
}

double number_of(std::string_view digits, const std::string& text) {
  double number = 0;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || !(number >= -kFarthest && number <= kFarthest))
    throw Failure("has '" + std::string(digits) + "' where a number belongs", "'" + text + "'",
                  "write it like elbow.y=90 or elbow=0,90,0");
  return number;
}

std::vector<double> numbers_of(const std::string& list, const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    numbers.push_back(number_of(std::string_view(list).substr(at, comma - at), text));
    at = comma + 1;
  }
  return numbers;
}

bool has_part(const Thing& thing, const std::string& name) {
  for (const KeyedPart& part : thing.parts)
    if (part.name == name || part.name == "/" + name) return true;
  return false;
}

// What the part is to be: its numbers at the frame, those wished for exchanged.
Json wished(const Wish& wish, const Thing& thing, const KeyedPart& part, std::uint32_t frame, Beyond beyond) {
  Json value = part.value_at(frame);
  if (!value.is_array()) return written(*wish.numbers[0]);
  glm::dvec3 numbers = vector_of(value);
  for (int axis = 0; axis < 3; ++axis) numbers[axis] = wish.numbers[axis].value_or(numbers[axis]);
  if (part.joint) numbers = within_limits(thing.name, *part.joint, numbers, beyond);
  return written(numbers);
}

// A new key goes on as the way did on which it stands.
Ease ease_there(const Track& track, std::uint32_t frame) {
  for (std::size_t i = 0; i + 1 < track.size(); ++i)
    if (track[i].frame <= frame && frame < track[i + 1].frame) return track[i].ease;
  return kLinear;
}

}  // namespace

Wish Wish::read(const std::string& text, const Thing& thing) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) refuse_wish(text);
  Wish wish{text.substr(0, equals), {}};
  const std::vector<double> numbers = numbers_of(text.substr(equals + 1), text);
  const bool with_axis = wish.part.size() > 2 && wish.part[wish.part.size() - 2] == '.' &&
                         wish.part.back() >= 'x' && wish.part.back() <= 'z' && !has_part(thing, wish.part);
  const std::size_t axis = with_axis ? std::size_t(wish.part.back() - 'x') : 0;
  if (with_axis) wish.part.resize(wish.part.size() - 2);
  wish.part = part_named(thing, wish.part);
  const bool three = thing.part(wish.part).value_at(0).is_array();
  const std::size_t needed = with_axis || !three ? 1 : 3;
  if (numbers.size() != needed || (with_axis && !three))
    throw Failure("has " + std::to_string(numbers.size()) + (numbers.size() == 1 ? " number" : " numbers"),
                  "'" + text + "'",
                  three ? "write one number for one axis, like elbow.y=90, or three for all: elbow=0,90,0"
                        : "write one number: " + wish.part + "=40");
  for (std::size_t i = 0; i < needed; ++i) wish.numbers[axis + i] = numbers[i];
  return wish;
}

glm::dvec3 within_limits(const std::string& thing, const Joint& joint, const glm::dvec3& pose, Beyond beyond) {
  const glm::dvec3 nearest = clamped(joint, pose);
  if (beyond == Beyond::clamped || largest_excess(joint, pose) <= kAngleRounding) return nearest;
  throw Failure(*broken_limit(joint, pose), thing + ", joint '" + joint.name + "'",
                "--clamp takes the nearest allowed, or widen the limits in its model");
}

Remarks pose(Json& film, const Film& meaning, const std::string& name, std::span<const std::string> wishes,
             std::uint32_t frame, const std::optional<Ease>& ease, Beyond beyond) {
  Chosen chosen = std::move(choose(film, meaning, {false, name, {}}).front());
  const Thing& thing = chosen.thing;
  Tracks tracks = tracks_of(*thing.json);
  std::set<std::string> touched;
  for (const std::string& text : wishes) {
    const Wish wish = Wish::read(text, thing);
    const KeyedPart& part = thing.part(wish.part);
    Track& track = tracks[part.name];
    if (track.empty() && frame > 0) track.push_back({0, part.value_at(0), kLinear, true});
    Json value = wished(wish, thing, part, frame, beyond);
    if (TrackKey* key = key_at(track, frame)) {
      // A second wish for the part keeps what the first one set.
      for (std::size_t axis = 0; touched.contains(part.name) && axis < 3 && value.is_array(); ++axis)
        if (!wish.numbers[axis]) value[axis] = key->value[axis];
      key->value = std::move(value);
    } else {
      put_key(track, {frame, std::move(value), ease_there(track, frame), true});
    }
    touched.insert(part.name);
  }
  if (ease) set_ease(tracks, frame, *ease);
  chosen.parts.assign(touched.begin(), touched.end());
  return put(chosen, tracks);
}

}  // namespace mars::host
