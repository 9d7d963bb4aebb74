// What pages show of a film's keys and of what can move it, as JSON (docs/studio-protocol.md, "Animation"): all values
// are computed here, pages draw them alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::studio {

using document::Json;

// `json` is what `film` was read from, and stays as it is. `things` as a person types them: "tom", "camera", "light/1",
// "material/skin"; {"*"}: all that have keys. What is none of the film's is left out.
Json channels_of(Json& json, const animator::Film& film, const std::vector<std::string>& things);

struct CurvesWanted {
  std::string thing;
  std::vector<std::string> parts;
  std::uint32_t first, last;  // frames
};

Json curves_of(Json& json, const animator::Film& film, const CurvesWanted& wanted);

Json actions();

}  // namespace mars::studio
