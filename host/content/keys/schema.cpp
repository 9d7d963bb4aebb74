#include "host/content/keys/schema.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "host/content/keys/key.h"

namespace mars::keys {
namespace {

using Json = nlohmann::ordered_json;

// Whole numbers without ".0".
Json plain(double number) {
  return number == std::floor(number) ? Json(static_cast<std::int64_t>(number)) : Json(number);
}

// Definitions of one of the two files; those of the model's are the film's, too.
class Schema {
 public:
  explicit Schema(bool film) : film_(film) {}

  // The file's own object, with the definitions of all others.
  Json file(std::span<const Object> objects, std::span<const Type> types, std::string_view title) const {
    const Object& whole = objects.front();
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"$id", std::string(whole.name) + ".schema.json"},
                {"title", title}};
    schema.update(of(whole));
    for (const Type& type : types) schema["$defs"][std::string(type.name)] = resolved(Json::parse(type.schema));
    for (const Object& object : objects.subspan(1)) schema["$defs"][std::string(object.name)] = of(object);
    return schema;
  }

 private:
  Json of(const Object& object) const {
    Json schema = Json::object();
    if (!object.meaning.empty()) schema["description"] = object.meaning;
    schema["type"] = "object";
    for (const Key& key : object.keys)
      if (key.required) schema["required"].push_back(key.name);
    if (!object.rules.empty()) schema.update(Json::parse(object.rules));
    schema["additionalProperties"] = false;
    const bool of_keys = object.name.ends_with("_key") && object.name != "matrices_key";
    for (const Key& key : object.keys)
      schema["properties"][std::string(key.name)] = of_keys && key.keyed ? of_keyed(key) : of(key);
    return schema;
  }

  Json of(const Key& key) const {
    Json schema{{"description", description(key)}};
    if (key.number)
      schema["default"] = plain(*key.number);
    else if (!key.json.empty())
      schema["default"] = Json::parse(key.json);
    schema.update(value(key.type, key));
    return schema;
  }

  // In a key the value may be a part with an ease and slopes of its own, but for those with a form for keys.
  Json of_keyed(const Key& key) const {
    if (!key.keyed_type.empty()) return value(key.type, key);
    return {{"anyOf", {value(key.type, key), reference("part")}}};
  }

  static std::string description(const Key& key) {
    std::string text;
    for (const char c : key.meaning)
      if (c != '`') text += c;
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    if (!key.unit.empty()) text += ", " + std::string(key.unit);
    return text + (key.without.empty() ? "." : ". Default: " + std::string(key.without) + ".");
  }

  Json value(std::string_view type, const Key& key) const {
    if (type == "number" || type == "whole")
      return {{"type", type == "whole" ? "integer" : "number"},
              {"minimum", plain(key.range.lowest)},
              {"maximum", plain(key.range.highest)}};
    if (type == "choice") return {{"enum", key.choices}};
    if (type == "text" || type == "file") return {{"type", "string"}, {"minLength", 1}};
    if (type == "flag") return {{"type", "boolean"}};
    if (type.front() == '{')
      return {{"type", "object"},
              {"propertyNames", reference("name")},
              {"additionalProperties", value(type.substr(1, type.size() - 2), key)}};
    if (type.front() != '[') return reference(type);
    Json list{{"type", "array"}, {"items", reference(type.substr(1, type.size() - 2))}};
    if (key.range != Range{}) list["minItems"] = plain(key.range.lowest);
    if (key.range != Range{} && key.range.highest < kFarthest) list["maxItems"] = plain(key.range.highest);
    return list;
  }

  Json reference(std::string_view name) const {
    if (name == "model") return {{"$ref", "model.schema.json"}};
    const auto is = [&](const auto& each) { return each.name == name; };
    const bool of_model =
        name == "library" || std::ranges::any_of(model_types(), is) || std::ranges::any_of(model_objects(), is);
    return {{"$ref", std::string(film_ && of_model ? "model.schema.json" : "") + "#/$defs/" + std::string(name)}};
  }

  // With references in place of "#name".
  Json resolved(Json schema) const {
    if (schema.is_string() && schema.get_ref<const std::string&>().starts_with('#'))
      return reference(schema.get_ref<const std::string&>().substr(1));
    if (schema.is_structured())
      for (Json& each : schema) each = resolved(std::move(each));
    return schema;
  }

  bool film_;
};

}  // namespace

Json film_schema() { return Schema(true).file(film_objects(), film_types(), "MARS film"); }

Json model_schema(std::span<const std::string_view> shapes) {
  Json schema = Schema(false).file(model_objects(), model_types(), "MARS model");
  schema["$defs"]["library"] = {{"description", "Shapes that every model can name."}, {"enum", shapes}};
  return schema;
}

}  // namespace mars::keys
