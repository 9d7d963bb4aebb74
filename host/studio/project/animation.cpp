#include "host/studio/project/animation.h"

#include <algorithm>
#include <optional>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/things.h"
#include "host/content/animator/keys/tracks.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/text.h"
#include "host/content/animator/motion/script/action.h"

namespace mars::studio {
namespace {

// Frames with keys, of all things: more would be too much for a page at each change.
constexpr std::size_t kMostKeysSent = 5000;

using animator::KeyedPart;
using animator::Thing;

constexpr std::size_t kMostValues = 200'000;  // of curves that are sent at once

// As a person types it.
std::string word_of(const Thing& thing) { return thing.actor ? thing.json->at("name").get<std::string>() : thing.name; }

std::string kind_of(const Thing& thing) { return thing.actor ? "actor" : thing.name.substr(0, thing.name.find('/')); }

// With the slash where without it another part would be meant.
std::string word_of(const Thing& thing, const std::string& part) {
  const std::string shown = animator::shown_part(part);
  const bool taken = std::ranges::any_of(thing.parts, [&](const KeyedPart& each) { return each.name == shown; });
  return taken ? part : shown;
}

struct Axis {
  std::string name;
  std::size_t number;
};

// What may change of it; none where it holds no numbers.
std::vector<Axis> axes_of(const KeyedPart& part, const Json& value) {
  if (value.is_number()) return {{"value", 0}};
  std::vector<Axis> axes;
  for (std::size_t axis = 0; value.is_array() && axis < value.size(); ++axis)
    if (!part.joint || part.joint->limits[static_cast<int>(axis)].free())
      axes.push_back({std::string(1, "xyz"[axis]), axis});
  return axes;
}

Json names_of(const std::vector<Axis>& axes) {
  Json names = Json::array();
  for (const Axis& axis : axes) names.push_back(axis.name);
  return names;
}

Json described(const animator::TrackKey& key) {
  Json json{{"frame", key.frame}, {"value", key.value}, {"ease", animator::written(key.ease)}};
  if (!key.in.is_null()) json["in"] = key.in;
  if (!key.out.is_null()) json["out"] = key.out;
  return json;
}

Json described(const Thing& thing) {
  const animator::Tracks tracks = animator::tracks_of(*thing.json);
  Json parts = Json::array();
  for (const KeyedPart& part : thing.parts) {
    const auto track = tracks.find(part.name);
    if (track == tracks.end()) continue;
    Json keys = Json::array();
    for (const animator::TrackKey& key : track->second) keys.push_back(described(key));
    parts.push_back({{"name", word_of(thing, part.name)},
                     {"axes", names_of(axes_of(part, part.value_at(0)))},
                     {"keys", std::move(keys)}});
  }
  return {{"thing", word_of(thing)}, {"kind", kind_of(thing)}, {"parts", std::move(parts)}};
}

Json named(const Thing& thing) {
  return {{"thing", word_of(thing)}, {"kind", kind_of(thing)}, {"parts", Json::array()}};
}

// None where the film has none of this name that has keys.
std::optional<Thing> thing_named(Json& json, const animator::Film& film, const std::string& name) {
  try {
    return animator::choose(json, film, {false, name, {}}).front().thing;
  } catch (const Failure&) {
    return std::nullopt;
  }
}

// Null where there are none.
Json limits_of(const KeyedPart& part, const std::vector<Axis>& axes) {
  if (!part.joint) return nullptr;
  Json limits = Json::array();
  for (const Axis& axis : axes) {
    const modeler::Limits& range = part.joint->limits[static_cast<int>(axis.number)];
    limits.push_back({animator::written(range.lower), animator::written(range.upper)});
  }
  return limits;
}

Json curves_of(const Thing& thing, const KeyedPart& part, std::uint32_t first, std::uint32_t last) {
  const std::vector<Axis> axes = axes_of(part, part.value_at(first));
  Json values = Json::array();
  for (std::size_t axis = 0; axis < axes.size(); ++axis) values.push_back(Json::array());
  for (std::uint32_t frame = first; frame <= last; ++frame) {
    const Json value = part.value_at(frame);
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      values[axis].push_back(value.is_number() ? value : value.at(axes[axis].number));
  }
  return {{"name", word_of(thing, part.name)},
          {"axes", names_of(axes)},
          {"limits", limits_of(part, axes)},
          {"values", std::move(values)}};
}

Json described(const motion::Parameter& parameter) {
  return {{"name", parameter.name},
          {"value", parameter.value},
          {"meaning", parameter.meaning},
          {"example", parameter.example},
          {"count", parameter.count()}};
}

}  // namespace

Json channels_of(Json& json, const animator::Film& film, const std::vector<std::string>& things) {
  Json sent = Json::array();
  const bool all = things == std::vector<std::string>{"*"};
  std::size_t keys = 0;
  if (all)
    for (const animator::Chosen& each : animator::choose(json, film, {true, "", {}})) {
      if (!each.thing.json->contains("keys")) continue;
      keys += each.thing.json->at("keys").size();
      sent.push_back(keys <= kMostKeysSent ? described(each.thing) : named(each.thing));
    }
  else
    for (const std::string& name : things)
      if (const auto thing = thing_named(json, film, name)) sent.push_back(described(*thing));
  return {{"is", "channels"}, {"things", std::move(sent)}};
}

Json curves_of(Json& json, const animator::Film& film, const CurvesWanted& wanted) {
  Json parts = Json::array();
  const auto fit = static_cast<std::uint32_t>(kMostValues / std::max<std::size_t>(wanted.parts.size(), 1));
  const std::uint32_t last = std::min(wanted.last, wanted.first + fit);
  if (const auto thing = thing_named(json, film, wanted.thing))
    for (const KeyedPart& part : thing->parts)
      if (std::ranges::find(wanted.parts, word_of(*thing, part.name)) != wanted.parts.end())
        parts.push_back(curves_of(*thing, part, wanted.first, last));
  return {{"is", "curves"}, {"thing", wanted.thing}, {"first", wanted.first}, {"parts", std::move(parts)}};
}

Json actions() {
  Json sent = Json::array();
  for (const motion::Action& action : motion::actions()) {
    Json parameters = Json::array();
    for (const motion::Parameter& parameter : action.parameters) parameters.push_back(described(parameter));
    sent.push_back({{"name", action.name},
                    {"purpose", action.purpose},
                    {"group", action.needs.empty() ? "kinematic" : "figure"},
                    {"needs", action.needs},
                    {"parameters", std::move(parameters)}});
  }
  return {{"is", "actions"}, {"actions", std::move(sent)}};
}

}  // namespace mars::studio
