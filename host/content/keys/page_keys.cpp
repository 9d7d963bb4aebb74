#include "host/content/keys/page_keys.h"

#include <nlohmann/json.hpp>
#include <string>

#include "host/content/keys/material_keys.h"

namespace mars::keys {
namespace {

using Json = nlohmann::ordered_json;

Json described(const Key& key) {
  Json json{{"type", key.type}, {"meaning", key.meaning}};
  if (key.type == "number" || key.type == "whole") {
    json["least"] = key.range.lowest;
    json["most"] = key.range.highest;
  }
  if (!key.unit.empty()) json["unit"] = key.unit;
  if (key.number) json["default"] = *key.number;
  if (!key.json.empty()) json["default"] = Json::parse(key.json);
  if (!key.choices.empty()) json["choices"] = key.choices;
  if (key.keyed) json["keyed"] = true;
  return json;
}

Json described(const Object& object) {
  Json json = Json::object();
  for (const Key& key : object.keys)
    if (key.typed) json[std::string(key.name)] = described(key);
  return json;
}

Json users_of(const MaterialNumber& number) {
  Json users = Json::array();
  for (unsigned i = 0; i < std::size(kReflections); ++i)
    if (uses(static_cast<wire::Reflection>(i), number)) users.push_back(kReflections[i]);
  return users;
}

}  // namespace

Json keys_of_pages() {
  Json json = Json::object();
  for (const char* name : {"film", "camera", "light", "material"}) json[name] = described(object(name));
  for (const MaterialNumber& number : kMaterialNumbers) {
    Json& key = json["material"][std::string(number.key.name)];
    key["slider"] = {number.slider.lowest, number.slider.highest};
    key["of"] = users_of(number);
  }
  return json;
}

}  // namespace mars::keys
