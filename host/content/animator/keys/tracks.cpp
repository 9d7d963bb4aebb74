#include "host/content/animator/keys/tracks.h"

#include <algorithm>

#include "host/content/animator/keys/written.h"

namespace mars::animator {
namespace {

// What one frame's key holds, by part.
using Held = std::map<std::string, const TrackKey*>;

bool before(const TrackKey& key, std::uint32_t frame) { return key.frame < frame; }

// What carries an actor stays from key to key: it has no ease.
bool has_ease(const std::string& part) { return part != "attach"; }

// That of the key as it was, while any part goes by it; else that of most.
Ease common_ease(const Held& held, const document::Json& old) {
  std::vector<Ease> eases;
  for (const auto& [part, key] : held)
    if (has_ease(part)) eases.push_back(key->ease);
  const Ease was = ease_of(old);
  if (eases.empty() || (!old.empty() && std::ranges::count(eases, was) > 0)) return was;
  return *std::ranges::max_element(eases, {}, [&](const Ease& ease) { return std::ranges::count(eases, ease); });
}

// The part's value, as an object where its slopes or its ease are its own. A part that stays, or whose last key this
// is, keeps its ease, too, for the keys to come.
document::Json value_of(const std::string& part, const TrackKey& key, const Ease& common) {
  const bool own_ease = key.ease != common;
  if (!has_ease(part) || (!own_ease && key.in.is_null() && key.out.is_null())) return key.value;
  document::Json value = {{"value", key.value}};
  if (own_ease) value["ease"] = written(key.ease);
  if (!key.in.is_null()) value["in"] = key.in;
  if (!key.out.is_null()) value["out"] = key.out;
  return value;
}

// The values of `held` in the order of `old`, then those that are new.
document::Json values_of(const Held& held, const Ease& common, const document::Json& old, bool joints) {
  document::Json values = document::Json::object();
  const auto put = [&](const std::string& name) {
    if (const auto found = held.find(joints ? "/" + name : name); found != held.end())
      values[name] = value_of(found->first, *found->second, common);
  };
  if (old.is_object())
    for (const auto& item : old.items()) put(item.key());
  for (const auto& [part, key] : held)
    if ((part[0] == '/') == joints) put(joints ? part.substr(1) : part);
  return values;
}

// A key that holds what it held keeps its order.
document::Json ordered_as(const document::Json& old, const document::Json& key) {
  document::Json ordered = document::Json::object();
  if (key.size() != old.size()) return key;
  for (const auto& item : old.items()) {
    const auto found = key.find(item.key());
    if (found == key.end()) return key;
    ordered[item.key()] = *found;
  }
  return ordered;
}

document::Json key_of(std::uint32_t frame, const Held& held, const document::Json& old) {
  const Ease common = common_ease(held, old);
  document::Json key = {{"frame", frame}};
  key.update(values_of(held, common, old, false));
  const document::Json pose = values_of(held, common, old.value("pose", document::Json()), true);
  if (!pose.empty()) key["pose"] = pose;
  if (common != kLinear || old.contains("ease")) key["ease"] = written(common);
  return ordered_as(old, key);
}

TrackKey track_key(std::uint32_t frame, const document::Json& written, const Ease& common) {
  if (!written.is_object() || !written.contains("value")) return {frame, written, common};
  TrackKey key{frame, written.at("value"), written.contains("ease") ? ease_of(written) : common};
  key.in = written.value("in", document::Json());
  key.out = written.value("out", document::Json());
  return key;
}

void drop_still_values(document::Json& thing, const Tracks& tracks) {
  for (const auto& [part, track] : tracks) {
    if (track.empty()) continue;
    if (part[0] != '/')
      thing.erase(part);
    else if (thing.contains("pose"))
      thing["pose"].erase(part.substr(1));
  }
  if (thing.contains("pose") && thing["pose"].empty()) thing.erase("pose");
}

template <typename Wanted>
Tracks tracks_of_parts(const document::Json& thing, Wanted wanted) {
  Tracks tracks;
  const auto keys = thing.find("keys");
  if (keys == thing.end()) return tracks;
  for (const document::Json& key : *keys) {
    const std::uint32_t frame = key.at("frame").get<std::uint32_t>();
    const Ease ease = ease_of(key);
    const auto add = [&](const std::string& part, const document::Json& value) {
      if (wanted(part)) tracks[part].push_back(track_key(frame, value, ease));
    };
    for (const auto& item : key.items()) {
      if (item.key() == "frame" || item.key() == "ease") continue;
      if (item.key() != "pose") {
        add(item.key(), item.value());
        continue;
      }
      for (const auto& joint : item.value().items()) add("/" + joint.key(), joint.value());
    }
  }
  return tracks;
}

}  // namespace

Tracks tracks_of(const document::Json& thing) {
  return tracks_of_parts(thing, [](const std::string&) { return true; });
}

Tracks tracks_of(const document::Json& thing, const std::vector<std::string>& parts) {
  return tracks_of_parts(thing, [&](const std::string& part) { return std::ranges::find(parts, part) != parts.end(); });
}

void put_tracks(document::Json& thing, const Tracks& tracks) {
  std::map<std::uint32_t, Held> frames;
  std::map<std::uint32_t, document::Json> old;
  if (const auto keys = thing.find("keys"); keys != thing.end())
    for (document::Json& key : *keys) {
      const std::uint32_t frame = key.at("frame").get<std::uint32_t>();
      if (key.size() == 1) frames[frame];  // a frame alone stays
      old[frame] = std::move(key);
    }
  for (const auto& [part, track] : tracks)
    for (const TrackKey& key : track) frames[key.frame][part] = &key;
  document::Json keys = document::Json::array();
  for (const auto& [frame, held] : frames) {
    const auto was = old.find(frame);
    keys.push_back(key_of(frame, held, was == old.end() ? document::Json::object() : was->second));
  }
  drop_still_values(thing, tracks);
  keys.empty() ? void(thing.erase("keys")) : void(thing["keys"] = std::move(keys));
}

bool leads_on(const Track& track, const TrackKey& key) {
  const TrackKey* next = &key + 1;
  return next != track.data() + track.size() && (next->value != key.value || key.ease.spline);
}

TrackKey* key_at(Track& track, std::uint32_t frame) {
  const auto found = std::lower_bound(track.begin(), track.end(), frame, before);
  return found != track.end() && found->frame == frame ? &*found : nullptr;
}

void put_key(Track& track, TrackKey key) {
  const auto place = std::lower_bound(track.begin(), track.end(), key.frame, before);
  if (place != track.end() && place->frame == key.frame)
    *place = std::move(key);
  else
    track.insert(place, std::move(key));
}

void set_ease(Tracks& tracks, const std::set<std::string>& parts, std::uint32_t frame, const Ease& ease) {
  for (const std::string& part : parts)
    if (const auto track = tracks.find(part); track != tracks.end())
      if (TrackKey* key = key_at(track->second, frame)) key->ease = ease;
}

std::string shown_part(const std::string& part) { return part[0] == '/' ? part.substr(1) : part; }

}  // namespace mars::animator
