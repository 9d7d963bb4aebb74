// "intensity=2", "color=1,0.8,0.6", "reflection=phong": what a person types to give an object of a film file values.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/content/document/json_file.h"

namespace mars::animator {

// Puts the values into the object as a film file writes them: a number, a list of numbers, or a text. Their meaning is
// checked by who reads the film. Throws where a word is no KEY=VALUE, or its key none of `keys`; `what` has them: "a
// light".
void set_fields(document::Json& object, std::span<const std::string> words, std::span<const std::string_view> keys,
                const std::string& what);

// As object[key] = value; a new key stands before those in `others` that are there.
void put_before(document::Json& object, const std::string& key, document::Json value,
                std::span<const std::string_view> others);

}  // namespace mars::animator
