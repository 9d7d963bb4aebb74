#include "host/content/keys/named_files.h"

#include <nlohmann/json.hpp>
#include <string_view>

namespace mars::keys {
namespace {

using Json = nlohmann::ordered_json;

template <typename AnyJson, typename Take>
void for_each_file(AnyJson& json, const Object& object, const Take& take);

template <typename AnyJson, typename Take>
void for_each_file_of(AnyJson& json, std::string_view type, const Take& take) {
  if (type == "file" || type == "model_or_file") {
    if (json.is_string()) return take(json);
    if (type == "file") return;
    type = "model";
  }
  if (type.front() == '{' || type.front() == '[') {
    if (json.is_structured())
      for (AnyJson& each : json) for_each_file_of(each, type.substr(1, type.size() - 2), take);
  } else if (const Object* const object = find_object(type)) {
    for_each_file(json, *object, take);
  }
}

template <typename AnyJson, typename Take>
void for_each_file(AnyJson& json, const Object& object, const Take& take) {
  if (!json.is_object()) return;
  for (const Key& key : object.keys)
    if (const auto value = json.find(key.name); value != json.end()) for_each_file_of(*value, key.type, take);
}

}  // namespace

std::vector<std::string> files_named_in(const Json& json, const Object& object) {
  std::vector<std::string> files;
  for_each_file(json, object, [&](const Json& file) { files.push_back(file); });
  return files;
}

void rename_files(Json& json, const Object& object, const std::function<std::string(const std::string&)>& renamed) {
  for_each_file(json, object, [&](Json& file) { file = renamed(file.get<std::string>()); });
}

}  // namespace mars::keys
