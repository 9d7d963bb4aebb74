#include "host/content/keys/page_keys.h"

#include <nlohmann/json.hpp>
#include <string>

#include "host/content/keys/material_keys.h"

namespace mars::keys {
namespace {

using Json = nlohmann::ordered_json;

// Which values there are, where its schema lists them; what each part of it is.
void add_type(Json& json, const Type& type) {
  const Json schema = Json::parse(type.schema);
  if (const auto values = schema.find("enum"); values != schema.end()) json["choices"] = *values;
  if (!type.parts.empty()) json["parts"] = type.parts;
}

Json described(const Key& key) {
  Json json{{"type", key.type}, {"meaning", key.meaning}};
  if (key.type == "number" || key.type == "whole" || key.range != Range{}) {
    json["least"] = key.range.lowest;
    json["most"] = key.range.highest;
  }
  const auto add = [&](const char* name, std::string_view text) {
    if (!text.empty()) json[name] = text;
  };
  add("unit", key.unit);
  add("without", key.without);
  add("label", key.label);
  if (Json value = default_of_pages(key); !value.is_null()) json["default"] = std::move(value);
  if (!key.choices.empty()) json["choices"] = key.choices;
  if (const Type* const type = find_type(key.type)) add_type(json, *type);
  if (key.keyed) json["keyed"] = true;
  if (key.rare) json["rare"] = true;
  return json;
}

Json kinds_of(const Object& object, const Key& key) {
  Json kinds = Json::array();
  for (unsigned kind = 0; kind < object.kinds.size(); ++kind)
    if (key.is_of(kind)) kinds.push_back(object.kinds[kind].name);
  return kinds;
}

// Of each kind what it has in place of the key's own.
Json measures_of(const Object& object, const Key& key) {
  Json measures = Json::object();
  for (unsigned kind = 0; kind < object.kinds.size(); ++kind) {
    const auto& [range, unit] = key.measures[kind];
    Json& measure = measures[std::string(object.kinds[kind].name)] = {{"least", range.lowest}, {"most", range.highest}};
    if (!unit.empty()) measure["unit"] = unit;
  }
  return measures;
}

Json described(const Object& object) {
  Json json = Json::object();
  for (const Key& key : object.keys)
    if (key.typed) {
      Json& shown = json[std::string(key.name)] = described(key);
      if (key.of != kEveryKind) shown["of"] = kinds_of(object, key);
      if (!key.measures.empty()) shown["measures"] = measures_of(object, key);
    }
  return json;
}

Json described(std::span<const Kind> kinds) {
  Json json = Json::array();
  for (const Kind& kind : kinds)
    json.push_back({{"name", kind.name}, {"label", kind.label}, {"begins_with", kind.begins_with}});
  return json;
}

Json users_of(const MaterialNumber& number) {
  Json users = Json::array();
  for (unsigned i = 0; i < std::size(kReflections); ++i)
    if (uses(static_cast<wire::Reflection>(i), number)) users.push_back(kReflections[i]);
  return users;
}

}  // namespace

Json default_of_pages(const Key& key) {
  if (key.number) return *key.number;
  return key.json.empty() ? Json() : Json::parse(key.json);
}

Json keys_of_pages() {
  Json json = Json::object();
  for (const char* name : {"film", "camera", "light", "material"}) json[name] = described(object(name));
  for (const MaterialNumber& number : kMaterialNumbers) {
    Json& key = json["material"][std::string(number.key.name)];
    key["slider"] = {number.slider.lowest, number.slider.highest};
    key["of"] = users_of(number);
  }
  json["kinds"]["light"] = described(object("light").kinds);
  return json;
}

}  // namespace mars::keys
