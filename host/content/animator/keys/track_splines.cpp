#include "host/content/animator/keys/track_splines.h"

#include <algorithm>

#include "host/content/animator/pose/channel.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/written.h"

namespace mars::animator {
namespace {

Key<glm::dvec3> numbers_of_key(const TrackKey& key) {
  Key<glm::dvec3> made{key.frame, numbers_of(key.value), key.ease};
  if (!key.in.is_null()) made.in = numbers_of(key.in);
  if (!key.out.is_null()) made.out = numbers_of(key.out);
  return made;
}

// The key, the next one and their neighbours, on which the spline between the two depends; and which of them it is.
struct Near {
  Channel<glm::dvec3> keys;
  std::size_t key;
  std::vector<const document::Json*> values{};
};

Near near(const Track& track, std::size_t key) {
  const std::size_t first = key == 0 ? 0 : key - 1, end = std::min(key + 3, track.size());
  Near found{{}, key - first};
  for (std::size_t i = first; i < end; ++i) {
    found.keys.push_back(numbers_of_key(track[i]));
    found.values.push_back(&track[i].value);
  }
  return found;
}

// Points of actors have no numbers.
bool has_numbers(const Near& near) {
  return std::ranges::none_of(near.values, [](const document::Json* value) { return value->is_object(); });
}

void keep_slopes_at(Track& track, std::size_t key) {
  if (!has_numbers(near(track, key))) return;
  const document::Json slope = own_slope(track, key);
  if (key > 0 && track[key - 1].ease.spline && track[key].in.is_null()) track[key].in = slope;
  if (track[key].ease.spline && track[key].out.is_null()) track[key].out = slope;
}

}  // namespace

glm::dvec3 numbers_of(const document::Json& value) {
  glm::dvec3 numbers(0);
  if (value.is_number()) return {value.get<double>(), 0, 0};
  for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
    numbers[static_cast<int>(i)] = value[i].get<double>();
  return numbers;
}

document::Json shaped_like(const document::Json& like, const glm::dvec3& numbers) {
  const glm::dvec3 shown = rounded(numbers);
  if (like.is_number()) return written(shown.x);
  return like.size() == 2 && like.is_array() ? written(glm::dvec2(shown)) : written(shown);
}

document::Json own_slope(const Track& track, std::size_t key) {
  const Near found = near(track, key);
  return shaped_like(track[key].value, slope_at(found.keys, found.key));
}

void keep_slopes(Track& track, std::uint32_t frame) {
  if (const TrackKey* key = key_at(track, frame)) keep_slopes_at(track, static_cast<std::size_t>(key - track.data()));
}

void split_spline(Track& track, std::size_t from, TrackKey& key) {
  key.ease = kSpline;
  const double time = double(key.frame - track[from].frame) / double(track[from + 1].frame - track[from].frame);
  const Near found = near(track, from);
  if (!has_numbers(found)) return;
  key.in = key.out = shaped_like(key.value, spline_slope_at(found.keys, {found.key, found.key + 1, time}));
}

void scale_slopes(Track& track, std::uint32_t first, std::uint32_t last, double factor) {
  const auto scale = [&](const TrackKey& key, document::Json& slope) {
    if (!slope.is_null()) slope = shaped_like(key.value, factor * numbers_of(slope));
  };
  for (TrackKey& key : track) {
    if (key.frame > first && key.frame <= last) scale(key, key.in);
    if (key.frame >= first && key.frame < last) scale(key, key.out);
  }
}

}  // namespace mars::animator
