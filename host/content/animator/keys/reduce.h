// Key reduction: motion with a key in nearly every frame, computed or captured, becomes splines through a handful of
// keys that a person can edit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "host/content/animator/keys/keys.h"

namespace mars::animator {

// How far the film may then be from what it is, at every frame.
struct ReductionError {
  double degrees;                  // of a joint or an actor's turn, of the camera's field of view
  std::optional<double> distance;  // of places; none: as far as the angle moves a point at the actor's size from it
};

struct Reduction {
  Remarks remarks;
  std::size_t keys_before = 0, keys_after = 0;      // of parts
  std::size_t frames_before = 0, frames_after = 0;  // that have any
};

// Of an actor's place, turn and joints, or of the camera's eye, at and fov, those of the choice that have three keys or
// more in the range. Parts take their keys from common frames. Throws where nothing is to be reduced.
Reduction reduce_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range,
                      const ReductionError& error);

}  // namespace mars::animator
