// Slopes of splines as a person sets them: by how much a value changes a frame where a spline reaches its key and where
// it leaves it.
#pragma once

#include <optional>
#include <string>

#include "host/content/animator/keys/keys.h"

namespace mars::animator {

struct SlopeChange {
  std::optional<std::string> in{}, out{};  // numbers as typed: "0.5", or "0,0.5,0" for all of a part
  bool flat = false;                       // both 0
  bool automatic = false;                  // both from the neighbouring keys again
};

// At the keys in the range of the parts that `part` names, "elbow.y" or "place". The ways that get a slope become
// splines. Throws where there is no such key.
Remarks set_slopes(document::Json& film, const Film& meaning, const std::string& thing, const std::string& part,
                   FrameRange range, const SlopeChange& change);

}  // namespace mars::animator
