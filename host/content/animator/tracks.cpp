#include "host/content/animator/tracks.h"

#include <algorithm>
#include <optional>

#include "host/content/animator/written.h"

namespace mars::animator {
namespace {

// What one frame's key holds, by part.
using Held = std::map<std::string, const TrackKey*>;

bool before(const TrackKey& key, std::uint32_t frame) { return key.frame < frame; }

// Whether anything changes on the way to the next key.
bool leads_on(const Track& track, const TrackKey& key) {
  const TrackKey* next = &key + 1;
  return next != track.data() + track.size() && next->value != key.value;
}

// The values of `held` in the order of `old`, then those that are new.
document::Json values_of(const Held& held, const document::Json& old, bool joints) {
  document::Json values = document::Json::object();
  const auto put = [&](const std::string& name) {
    if (const auto found = held.find(joints ? "/" + name : name); found != held.end())
      values[name] = found->second->value;
  };
  if (old.is_object())
    for (const auto& item : old.items()) put(item.key());
  for (const auto& [part, key] : held)
    if ((part[0] == '/') == joints) put(joints ? part.substr(1) : part);
  return values;
}

class Composer {
 public:
  explicit Composer(const Tracks& tracks) : tracks_(tracks) {}

  document::Json key_of(std::uint32_t frame, const Held& held, const document::Json& old) {
    document::Json key = {{"frame", frame}};
    key.update(values_of(held, old, false));
    const document::Json pose = values_of(held, old.value("pose", document::Json()), true);
    if (!pose.empty()) key["pose"] = pose;
    const Ease ease = ease_for(frame, held, old);
    if (ease != kLinear || old.contains("ease")) key["ease"] = written(ease);
    return key;
  }

  std::vector<std::string> gave_way;

 private:
  Ease ease_for(std::uint32_t frame, const Held& held, const document::Json& old) {
    std::optional<Ease> chosen;
    for (const bool changed : {false, true})
      for (const auto& [part, key] : held)
        if (key->changed == changed && leads_on(tracks_.at(part), *key)) {
          if (chosen && *chosen != key->ease)
            gave_way.push_back(shown_part(part) + " at frame " + std::to_string(frame));
          if (!chosen) chosen = key->ease;
        }
    if (chosen) return *chosen;
    // The last key of all its parts: its ease rules once others follow.
    const auto agrees = [&](const auto& each) { return each.second->ease == held.begin()->second->ease; };
    return held.empty() || (old.contains("ease") && !std::ranges::all_of(held, agrees)) ? ease_of(old)
                                                                                        : held.begin()->second->ease;
  }

  const Tracks& tracks_;
};

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

}  // namespace

Tracks tracks_of(const document::Json& thing) {
  Tracks tracks;
  const auto keys = thing.find("keys");
  if (keys == thing.end()) return tracks;
  for (const document::Json& key : *keys) {
    const std::uint32_t frame = key.at("frame").get<std::uint32_t>();
    const Ease ease = ease_of(key);
    for (const auto& item : key.items()) {
      if (item.key() == "frame" || item.key() == "ease") continue;
      if (item.key() != "pose") {
        tracks[item.key()].push_back({frame, item.value(), ease});
        continue;
      }
      for (const auto& joint : item.value().items()) tracks["/" + joint.key()].push_back({frame, joint.value(), ease});
    }
  }
  return tracks;
}

std::vector<std::string> put_tracks(document::Json& thing, const Tracks& tracks) {
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
  Composer composer(tracks);
  document::Json keys = document::Json::array();
  for (const auto& [frame, held] : frames) {
    const auto was = old.find(frame);
    keys.push_back(composer.key_of(frame, held, was == old.end() ? document::Json::object() : was->second));
  }
  drop_still_values(thing, tracks);
  keys.empty() ? void(thing.erase("keys")) : void(thing["keys"] = std::move(keys));
  return composer.gave_way;
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

void set_ease(Tracks& tracks, std::uint32_t frame, const Ease& ease) {
  for (auto& [part, track] : tracks)
    if (TrackKey* key = key_at(track, frame)) key->ease = ease;
}

std::string shown_part(const std::string& part) { return part[0] == '/' ? part.substr(1) : part; }

}  // namespace mars::animator
