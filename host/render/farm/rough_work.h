// How long nodes work for frames, roughly, from what the film says of them alone: for choices that are not worth a
// forecast.
#pragma once

#include "node/wire/film.h"

namespace mars::farm {

// Seconds of one processor for a frame of an interval.
struct RoughWork {
  double keyframe = 0;
  double inbetween = 0;
};

// Patches and meshlets that move in the interval; of skins by the share of bones that do.
double moving_patches(const wire::PackedFilm& film, const wire::Interval& interval);

RoughWork rough_work(const wire::PackedFilm& film, const wire::Interval& interval);

}  // namespace mars::farm
