// Splines through the keys of a track, whose values and slopes are as in the film file.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "host/content/animator/keys/tracks.h"

namespace mars::animator {

// One to three numbers, the others 0; 0 of a point of an actor, which has none.
glm::dvec3 numbers_of(const document::Json& value);
// As many of them as `like` has, of a point of an actor three.
document::Json shaped_like(const document::Json& like, const glm::dvec3& numbers);

// The slope of a spline at the key if it has none of its own.
document::Json own_slope(const Track& track, std::size_t key);

// Writes the slopes with which splines reach and leave the key at the frame where it has none, so that they stay
// whatever its neighbours become. Points of actors, which are elsewhere in every frame, get none.
void keep_slopes(Track& track, std::uint32_t frame);

// `key` is to stand on the spline from track[from] to the next key, which have slopes of their own: the cubic becomes
// two, with the slopes that it has.
// Not between points of actors.
void split_spline(Track& track, std::size_t from, TrackKey& key);

// Multiplies the slopes of splines between `first` and `last`.
void scale_slopes(Track& track, std::uint32_t first, std::uint32_t last, double factor);

}  // namespace mars::animator
