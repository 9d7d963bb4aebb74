// The table of keys as the studio's page has it: {"material": {"roughness": {...}, ...}, "light": ..., "camera": ...,
// "film": ...}.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace mars::keys {

// Of each key {"type", "meaning"} and, where it has them, "least", "most", "unit", "default", "choices", "keyed"; of a
// material's numbers also "slider": [least, most] and "of": names of the reflection models that use it.
nlohmann::ordered_json keys_of_pages();

}  // namespace mars::keys
