#include "host/content/animator/reading/film_version.h"

#include <algorithm>

namespace mars::animator {
namespace {

using document::Json;

bool new_ease(const Json& key) {
  const Json ease = key.value("ease", Json());
  return ease == "spline" || ease == "hold";
}

// Values are numbers in version 1, but for "pose".
bool new_part(const std::string& name, const Json& value) {
  if (name == "attach") return true;
  if (name != "pose") return value.is_object();
  return value.is_object() && std::ranges::any_of(value, [](const Json& joint) { return joint.is_object(); });
}

bool new_in_keys(const Json& thing) {
  const auto keys = thing.find("keys");
  return keys != thing.end() && std::ranges::any_of(*keys, [](const Json& key) {
           if (new_ease(key)) return true;
           for (const auto& item : key.items())
             if (new_part(item.key(), item.value())) return true;
           return false;
         });
}

bool needs_version_2(const Json& film) {
  const Json& camera = film.at("camera");
  if (camera.value("eye", Json()).is_object() || camera.value("at", Json()).is_object() || new_in_keys(camera))
    return true;
  for (const Json& actor : film.at("actors"))
    if (actor.contains("attach") || new_in_keys(actor)) return true;
  for (const char* group : {"lights", "materials"})
    if (const auto found = film.find(group); found != film.end() && std::ranges::any_of(*found, new_in_keys))
      return true;
  return false;
}

}  // namespace

bool needs_newer_version(const Json& film) { return film.value("version", 0) < 2 && needs_version_2(film); }

void write_version(Json& film) {
  if (!needs_newer_version(film)) return;
  film.erase("version");
  Json versioned = {{"version", 2}};
  versioned.update(film);
  film = std::move(versioned);
}

}  // namespace mars::animator
