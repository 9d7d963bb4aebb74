#include "host/content/keys/named_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

namespace mars::keys {
namespace {

using Json = nlohmann::ordered_json;

bool is_list(std::string_view type) { return type.front() == '{' || type.front() == '['; }

std::string_view type_of_each(std::string_view list) { return list.substr(1, list.size() - 2); }

// In any object below. A film of captured motion has lists of a million keys that name none.
bool may_name_files(std::string_view type) {
  while (is_list(type)) type = type_of_each(type);
  if (type == "file" || type == "model_or_file") return true;
  const Object* const object = find_object(type);
  return object != nullptr && std::ranges::any_of(object->keys, may_name_files, &Key::type);
}

template <typename AnyJson, typename Take>
void for_each_file(AnyJson& json, const Object& object, const Take& take);

template <typename AnyJson, typename Take>
void for_each_file_of(AnyJson& json, std::string_view type, const Take& take) {
  if (type == "file" || type == "model_or_file") {
    if (json.is_string()) return take(json);
    if (type == "file") return;
    type = "model";
  }
  if (is_list(type)) {
    if (json.is_structured() && may_name_files(type))
      for (AnyJson& each : json) for_each_file_of(each, type_of_each(type), take);
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
