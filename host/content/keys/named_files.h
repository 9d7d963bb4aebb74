// The files that a film or model file names: the values of all keys whose type is "file", and models of films that are
// files.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/content/keys/key.h"

namespace mars::keys {

// As they are written, in any object below. What has not the form of a film or model is passed over.
std::vector<std::string> files_named_in(const nlohmann::ordered_json& json, const Object& object);

// Makes each of the same names what `renamed` returns for the name, as where the JSON comes into another folder.
void rename_files(nlohmann::ordered_json& json, const Object& object,
                  const std::function<std::string(const std::string&)>& renamed);

}  // namespace mars::keys
