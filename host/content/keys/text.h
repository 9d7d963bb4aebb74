// The table of keys as people read it: helps of options, tables in a terminal and in docs/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/content/keys/key.h"

namespace mars::keys {

// "0 to 10", "0.01 to 179 degrees", "phong, gouraud, flat"; "" of a key whose type says it all.
std::string range_of(const Key& key);

// "0.5", "[0, 0, 0]", "required", or in words.
std::string default_of(const Key& key);

// "1 0 0.5": its example as words.
std::string words_of_example(const Key& key);

// Help of an option: "Share of ... (0 to 10). Example: --ambient 0.1", with `before` the example's words.
std::string help_of(const Key& key, std::string_view before);

// "color, reflection, ... or sides": the keys that commands take.
std::string names_of(const Object& object);

// What may be typed of it, for completion: "roughness=", "reflection=phong", "reflection=blinn-phong".
std::vector<std::string> typed_forms(const Object& object);

// Its rows for a terminal: the key, then what it means, its range and its default.
std::string table_of(const Object& object);

// Its rows in Markdown, with a column "in keys" where keys of a film change one.
std::string markdown_of(const Object& object);

}  // namespace mars::keys
