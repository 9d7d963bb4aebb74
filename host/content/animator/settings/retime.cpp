#include "host/content/animator/settings/retime.h"

#include <algorithm>
#include <cmath>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/tracks.h"
#include "node/wire/film.h"

namespace mars::animator {
namespace {

using document::Json;

constexpr std::uint32_t kClose = 2;  // frames between keys of captured motion
constexpr double kFar = 90;          // numbers that differ more may be the same turn, written otherwise

bool is_numbers(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const Json& each) { return each.is_number(); });
}

void scale(Json& slope, double factor) {
  if (slope.is_number()) slope = rounded(slope.get<double>() * factor);
  if (slope.is_array())
    for (Json& each : slope) scale(each, factor);
}

// `part` of the way from one value to the other, or nothing where there is no straight way.
Json mixed(const Json& from, const Json& to, double part) {
  if (!is_numbers(from) || !is_numbers(to) || from.size() != to.size()) return nullptr;
  Json value = Json::array();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double a = from[i], b = to[i];
    if (std::abs(b - a) > kFar) return nullptr;
    value.push_back(rounded(a + part * (b - a)));
  }
  return value;
}

bool leads_straight(const TrackKey& key, const TrackKey& next) {
  return key.ease == kLinear && next.frame - key.frame <= kClose;
}

// Of the track at the time to which its key `number` was rounded.
Json value_there(const Track& track, std::size_t number, double time) {
  const TrackKey& key = track[number];
  const std::size_t other = time < key.frame ? number - 1 : number + 1;
  if (time == key.frame || other >= track.size()) return key.value;
  const TrackKey &from = track[std::min(number, other)], &to = track[std::max(number, other)];
  if (!leads_straight(from, to)) return key.value;
  const Json value = mixed(from.value, to.value, (time - from.frame) / (double(to.frame) - from.frame));
  return value.is_null() ? key.value : value;
}

Track retimed(const Track& track, double factor) {
  Track all;
  for (std::size_t number = 0; number < track.size(); ++number) {
    TrackKey key = track[number];
    // A frame that no film has is refused when the film is read.
    key.frame = static_cast<std::uint32_t>(std::min(std::round(key.frame * factor), wire::kMostFrames + 1.0));
    key.value = value_there(track, number, key.frame / factor);
    scale(key.in, 1 / factor);
    scale(key.out, 1 / factor);
    put_key(all, std::move(key));
  }
  return all;
}

void retime_matrices(Json& keys, double factor) {
  Json all = Json::array();
  for (Json& key : keys) {
    key["frame"] = std::llround(key.at("frame").get<double>() * factor);
    if (!all.empty() && all.back().at("frame") == key.at("frame"))
      all.back().at("segments").update(key.at("segments"));  // a frame has only those that change
    else
      all.push_back(std::move(key));
  }
  keys = std::move(all);
}

}  // namespace

void retime_actor(Json& actor, double factor) {
  if (actor.contains("matrices")) retime_matrices(actor.at("matrices"), factor);
  if (!actor.contains("keys")) return;
  Tracks tracks = tracks_of(actor);
  for (auto& [part, track] : tracks) track = retimed(track, factor);
  put_tracks(actor, tracks);
}

}  // namespace mars::animator
