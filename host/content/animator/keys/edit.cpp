#include "host/content/animator/keys/edit.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/tracks.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

// A slope of the part, if the key has one.
document::Json slope_of(const std::map<std::string, glm::dvec3>& slopes, const std::string& part) {
  const auto found = slopes.find(part);
  return found == slopes.end() ? document::Json() : written(found->second);
}

void put(Tracks& tracks, const ActorKey& key) {
  const auto set = [&](const std::string& part, document::Json value) {
    Track& track = tracks[part];
    const TrackKey* old = key_at(track, key.frame);
    TrackKey made{key.frame, std::move(value), key.ease ? *key.ease : old ? old->ease : kLinear};
    made.in = slope_of(key.in, part);
    made.out = slope_of(key.out, part);
    put_key(track, std::move(made));
  };
  if (key.place) set("place", written(*key.place));
  if (key.turn) set("turn", written(*key.turn));
  if (key.attach) set("attach", written(*key.attach));
  for (const auto& [joint, angles] : key.pose) set("/" + joint, written(angles));
}

// The value that the part has beside the keys; null if it has none.
document::Json still_value(const document::Json& actor, const std::string& part) {
  if (part[0] != '/') return actor.value(part, document::Json());
  const auto pose = actor.find("pose");
  return pose == actor.end() ? document::Json() : pose->value(part.substr(1), document::Json());
}

}  // namespace

document::Json written(const AttachKey& attach) {
  if (attach.actor.empty()) return nullptr;
  document::Json json{{"actor", attach.actor}};
  if (!attach.joint.empty()) json["joint"] = attach.joint;
  if (attach.place != glm::dvec3(0)) json["place"] = written(attach.place);
  if (attach.turn != glm::dvec3(0)) json["turn"] = written(attach.turn);
  return json;
}

document::Json& actor_of(document::Json& film, const std::string& actor) {
  std::vector<std::string> names;
  for (document::Json& each : film.at("actors")) {
    names.push_back(each.at("name").get<std::string>());
    if (names.back() == actor) return each;
  }
  throw Failure("is no actor of the film", "'" + actor + "'",
                document::did_you_mean(actor, std::vector<std::string_view>(names.begin(), names.end()),
                                       "name one of its actors, or add it to the film"));
}

void put_keys(document::Json& film, const std::string& actor, std::span<const ActorKey> keys) {
  document::Json& object = actor_of(film, actor);
  if (object.contains("matrices"))
    throw Failure("is moved by matrices, which have no keys", "actor '" + actor + "'",
                  "take its matrices out of the film, or move another actor");
  if (keys.empty()) return;
  Tracks tracks = tracks_of(object);
  for (const ActorKey& key : keys) put(tracks, key);
  for (auto& [part, track] : tracks)
    if (document::Json still = still_value(object, part); !still.is_null() && !key_at(track, 0))
      put_key(track, {0, std::move(still), kLinear});
  put_tracks(object, tracks);
}

void clear_keys(document::Json& film, const std::string& actor, std::uint32_t first, std::uint32_t last,
                const ActorKey& like) {
  document::Json& object = actor_of(film, actor);
  Tracks tracks = tracks_of(object);
  const auto clear = [&](const std::string& part) {
    if (const auto track = tracks.find(part); track != tracks.end())
      std::erase_if(track->second, [&](const TrackKey& key) { return key.frame >= first && key.frame <= last; });
  };
  if (like.place) clear("place");
  if (like.turn) clear("turn");
  if (like.attach) clear("attach");
  for (const auto& [joint, angles] : like.pose) clear("/" + joint);
  put_tracks(object, tracks);
}

double rounded(double value) {
  if (std::abs(value) < 1e-9) return 0;
  return document::rounded_to(value, 9);
}

glm::dvec2 rounded(const glm::dvec2& value) { return {rounded(value.x), rounded(value.y)}; }

glm::dvec3 rounded(const glm::dvec3& value) { return {rounded(value.x), rounded(value.y), rounded(value.z)}; }

}  // namespace mars::animator
