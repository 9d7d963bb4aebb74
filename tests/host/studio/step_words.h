// Steps as tests say and read them.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "host/content/document/json_file.h"

namespace mars::studio {

using document::Json;

// "model set leg --place 1 2 3", words between blanks, as a step.
Json step(const std::string& words);
// `animate pose THING SETTINGS --frame F --clamp`.
Json pose(const std::string& thing, const std::string& settings, std::uint32_t frame);

// What a step of one command does: {"does": "pose", "of": "tom", "frame": 3, "elbow": [0, 90, 0], "fov": 30}, a
// setting's numbers as a list or one number; {"does": "set", "of": "leg", "place": [1, 2, 3]} of options of `model`;
// {"does": "turn", "elbow": [0, 90, 0]} of a model that is posed.
Json effect_of(const Json& step);

}  // namespace mars::studio
