// The tables of the two files, and what they share.
#pragma once

#include <string_view>
#include <vector>

#include "host/content/keys/key.h"

namespace mars::keys {

std::vector<Object> make_film_objects();   // film_keys.cpp
std::vector<Object> make_model_objects();  // model_keys.cpp

Object shape_options();  // model_keys.cpp

// The keys of a material that is not keyed.
std::vector<Key> material_keys();
inline constexpr std::string_view kMaterialExample = R"({"color": [0.8, 0.4, 0.2]})";

}  // namespace mars::keys
