#include "host/content/keys/named_files.h"

#include <nlohmann/json.hpp>
#include <string_view>

namespace mars::keys {
namespace {

using Json = nlohmann::ordered_json;

void add_files(const Json& json, const Object& object, std::vector<std::string>& files);

void add_files_of(const Json& json, std::string_view type, std::vector<std::string>& files) {
  if (type == "file" || type == "model_or_file") {
    if (json.is_string()) return files.push_back(json);
    if (type == "file") return;
    type = "model";
  }
  if (type.front() == '{' || type.front() == '[') {
    for (const Json& each : json)
      if (json.is_structured()) add_files_of(each, type.substr(1, type.size() - 2), files);
  } else if (const Object* const object = find_object(type)) {
    add_files(json, *object, files);
  }
}

void add_files(const Json& json, const Object& object, std::vector<std::string>& files) {
  if (!json.is_object()) return;
  for (const Key& key : object.keys)
    if (const auto value = json.find(key.name); value != json.end()) add_files_of(*value, key.type, files);
}

}  // namespace

std::vector<std::string> files_named_in(const Json& json, const Object& object) {
  std::vector<std::string> files;
  add_files(json, object, files);
  return files;
}

}  // namespace mars::keys
