// The table of keys as the studio's page has it: {"material": {"roughness": {...}, ...}, "light": ..., "camera": ...,
// "film": ..., "kinds": {"light": [...]}}.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/content/keys/key.h"

namespace mars::keys {

// Of each key {"type", "meaning"} and, where it has them, "least", "most", "unit", "default", "without", "label",
// "choices", "parts", "keyed", "rare", and "of": names of the kinds of its object that have it, of a material's numbers
// the reflection models; these also have "slider": [least, most]. Of each kind of light {"name", "label",
// "begins_with"}.
nlohmann::ordered_json keys_of_pages();

// As a file writes it; null where the key has none.
nlohmann::ordered_json default_of_pages(const Key& key);

}  // namespace mars::keys
