#include "host/content/animator/edit.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/tracks.h"
#include "host/content/animator/written.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

// Sets a value before "ease", which stays last.
void set(document::Json& key, const char* name, const document::Json& value) {
  const bool moves = !key.contains(name) && key.contains("ease");
  key[name] = value;
  if (!moves) return;
  const document::Json ease = key.at("ease");
  key.erase("ease");
  key["ease"] = ease;
}

using KeysByFrame = std::map<std::uint32_t, document::Json>;

KeysByFrame keys_of(const document::Json& actor) {
  KeysByFrame keys;
  if (const auto found = actor.find("keys"); found != actor.end())
    for (const document::Json& key : *found) keys.emplace(key.at("frame").get<std::uint32_t>(), key);
  return keys;
}

document::Json& key_at(KeysByFrame& keys, std::uint32_t frame) {
  return keys.try_emplace(frame, document::Json{{"frame", frame}}).first->second;
}

void put(KeysByFrame& keys, const ActorKey& key) {
  document::Json& item = key_at(keys, key.frame);
  if (key.place) set(item, "place", written(*key.place));
  if (key.turn) set(item, "turn", written(*key.turn));
  if (!key.pose.empty()) {
    document::Json pose = item.value("pose", document::Json::object());
    for (const auto& [joint, angles] : key.pose) pose[joint] = written(angles);
    set(item, "pose", pose);
  }
  if (key.attach) set(item, "attach", written(*key.attach));
  if (key.ease) item["ease"] = written(*key.ease);
}

bool any_keys(const KeysByFrame& keys, const char* name) {
  for (const auto& [frame, key] : keys)
    if (key.contains(name)) return true;
  return false;
}

void move_still_vector(document::Json& actor, KeysByFrame& keys, const char* name) {
  if (!actor.contains(name) || !any_keys(keys, name)) return;
  document::Json& first = key_at(keys, 0);
  if (!first.contains(name)) set(first, name, actor.at(name));
  actor.erase(name);
}

void move_still_pose(document::Json& actor, KeysByFrame& keys) {
  const auto still = actor.find("pose");
  if (still == actor.end()) return;
  std::map<std::string, bool> keyed;
  for (const auto& [frame, key] : keys)
    if (key.contains("pose"))
      for (const auto& joint : key.at("pose").items()) keyed[joint.key()] = true;
  document::Json left = document::Json::object(), moved = document::Json::object();
  for (const auto& joint : still->items()) (keyed[joint.key()] ? moved : left)[joint.key()] = joint.value();
  if (moved.empty()) return;
  document::Json& first = key_at(keys, 0);
  document::Json pose = first.value("pose", document::Json::object());
  for (const auto& joint : moved.items())
    if (!pose.contains(joint.key())) pose[joint.key()] = joint.value();
  set(first, "pose", pose);
  left.empty() ? void(actor.erase("pose")) : void(actor["pose"] = left);
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
  KeysByFrame all = keys_of(object);
  for (const ActorKey& key : keys) put(all, key);
  for (const char* name : {"place", "turn", "attach"}) move_still_vector(object, all, name);
  move_still_pose(object, all);
  document::Json list = document::Json::array();
  for (auto& [frame, key] : all) list.push_back(std::move(key));
  object["keys"] = std::move(list);
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
