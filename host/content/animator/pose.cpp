#include "host/content/animator/pose.h"

#include <set>

#include "hal/failure/failure.h"
#include "host/content/animator/tracks.h"
#include "host/content/animator/written.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

[[noreturn]] void refuse_setting(const std::string& text) {
  throw Failure("is not PART=NUMBERS", "'" + text + "'",
                "write it like elbow.y=90, elbow=0,90,0, place=2,0,0 or turn.z=45");
}

// How the part is written, by what it is now.
std::string remedy_for(const std::string& part, const document::Json& now) {
  if (!now.is_array()) return "write one number: " + part + "=" + now.dump();
  return "write one number for one axis, like " + part + ".y=" + now[1].dump() + ", or three for all: " + part + "=" +
         now[0].dump() + "," + now[1].dump() + "," + now[2].dump();
}

double number_of(std::string_view digits, const std::string& text, const std::string& remedy) {
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const auto number = document::number_in<double>(digits);
  if (!number || !(*number >= -document::kFarthest && *number <= document::kFarthest))
    throw Failure("has '" + std::string(digits) + "' where a number belongs", "'" + text + "'", remedy);
  return *number;
}

std::vector<double> numbers_of(const std::string& list, const std::string& text, const std::string& remedy) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    numbers.push_back(number_of(std::string_view(list).substr(at, comma - at), text, remedy));
    at = comma + 1;
  }
  return numbers;
}

bool has_part(const Thing& thing, const std::string& name) {
  for (const KeyedPart& part : thing.parts)
    if (part.name == name || part.name == "/" + name) return true;
  return false;
}

// What the part is to be: its numbers at the frame, those given exchanged.
document::Json value_after(const PartSetting& setting, const Thing& thing, const KeyedPart& part, std::uint32_t frame,
                           Beyond beyond, Remarks& remarks) {
  document::Json value = part.value_at(frame);
  if (!value.is_array()) return written(*setting.numbers[0]);
  glm::dvec3 numbers = vector_of(value);
  for (int axis = 0; axis < 3; ++axis) numbers[axis] = setting.numbers[axis].value_or(numbers[axis]);
  if (part.joint) numbers = within_limits(thing.name, *part.joint, numbers, beyond, remarks);
  return written(numbers);
}

// Refuses an axis that an earlier setting has set; `set` are the parts and axes of those.
void refuse_twice(const PartSetting& setting, const std::string& text, std::set<std::pair<std::string, int>>& set) {
  for (int axis = 0; axis < 3; ++axis)
    if (setting.numbers[axis] && !set.emplace(setting.part, axis).second)
      throw Failure("sets what an earlier word has set", "'" + text + "'", "give each part and axis once");
}

// A new key goes on as the way did on which it stands.
Ease ease_there(const Track& track, std::uint32_t frame) {
  for (std::size_t i = 0; i + 1 < track.size(); ++i)
    if (track[i].frame <= frame && frame < track[i + 1].frame) return track[i].ease;
  return kLinear;
}

Remarks pose_chosen(Chosen chosen, std::span<const PartSetting> settings, std::uint32_t frame,
                    const std::optional<Ease>& ease, Beyond beyond) {
  const Thing& thing = chosen.thing;
  Tracks tracks = tracks_of(*thing.json);
  std::set<std::string> touched;
  Remarks remarks;
  for (const PartSetting& setting : settings) {
    const KeyedPart& part = thing.part(setting.part);
    Track& track = tracks[part.name];
    if (track.empty() && frame > 0) track.push_back({0, part.key_at(0), kLinear, true});
    document::Json value = value_after(setting, thing, part, frame, beyond, remarks);
    if (TrackKey* key = key_at(track, frame)) {
      // A second setting for the part keeps what the first one set.
      for (std::size_t axis = 0; touched.contains(part.name) && axis < 3 && value.is_array(); ++axis)
        if (!setting.numbers[axis]) value[axis] = key->value[axis];
      key->value = std::move(value);
    } else {
      put_key(track, {frame, std::move(value), ease_there(track, frame), true});
    }
    touched.insert(part.name);
  }
  if (ease) set_ease(tracks, frame, *ease);
  chosen.parts.assign(touched.begin(), touched.end());
  const Remarks more = put(chosen, tracks);
  remarks.insert(remarks.end(), more.begin(), more.end());
  return remarks;
}

}  // namespace

PartSetting PartSetting::read(const std::string& text, const Thing& thing) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) refuse_setting(text);
  PartSetting setting{text.substr(0, equals), {}};
  const bool with_axis = setting.part.size() > 2 && setting.part[setting.part.size() - 2] == '.' &&
                         setting.part.back() >= 'x' && setting.part.back() <= 'z' && !has_part(thing, setting.part);
  const std::size_t axis = with_axis ? std::size_t(setting.part.back() - 'x') : 0;
  if (with_axis) setting.part.resize(setting.part.size() - 2);
  const std::string typed = setting.part;
  setting.part = part_named(thing, typed);
  const document::Json now = thing.part(setting.part).value_at(0);
  if (now.is_null()) throw Failure("has no numbers", "'" + text + "'", "use the commands attach and detach");
  const std::string remedy = remedy_for(typed, now);
  const std::vector<double> numbers = numbers_of(text.substr(equals + 1), text, remedy);
  const bool three = now.is_array();
  const std::size_t needed = with_axis || !three ? 1 : 3;
  if (numbers.size() != needed || (with_axis && !three))
    throw Failure("has " + document::counted(numbers.size(), "number"), "'" + text + "'", remedy);
  for (std::size_t i = 0; i < needed; ++i) setting.numbers[axis + i] = numbers[i];
  return setting;
}

Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const PartSetting> settings,
             std::uint32_t frame, const std::optional<Ease>& ease, Beyond beyond) {
  return pose_chosen(std::move(choose(film, meaning, {false, name, {}}).front()), settings, frame, ease, beyond);
}

Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const std::string> settings,
             std::uint32_t frame, const std::optional<Ease>& ease, Beyond beyond) {
  Chosen chosen = std::move(choose(film, meaning, {false, name, {}}).front());
  std::set<std::pair<std::string, int>> set;
  std::vector<PartSetting> read;
  for (const std::string& text : settings) {
    read.push_back(PartSetting::read(text, chosen.thing));
    refuse_twice(read.back(), text, set);
  }
  return pose_chosen(std::move(chosen), read, frame, ease, beyond);
}

}  // namespace mars::animator
