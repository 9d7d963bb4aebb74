// The files that a film or model file names: the values of all keys whose type is "file", and models of films that are
// files.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/content/keys/key.h"

namespace mars::keys {

// As they are written, in any object below. What has not the form of a film or model is passed over.
std::vector<std::string> files_named_in(const nlohmann::ordered_json& json, const Object& object);

}  // namespace mars::keys
