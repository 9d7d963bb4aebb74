#include "host/content/document/forms.h"

#include <algorithm>

#include "host/content/document/text.h"
#include "host/content/keys/key.h"

namespace mars::document {
namespace {

using keys::Key;
using keys::Object;

// The object that a value of the type is where it is an object at all: "light" of "light", "point" of "place_or_point".
const Object* object_in(std::string_view type) {
  if (const Object* const object = keys::find_object(type)) return object;
  const keys::Type* const known = keys::find_type(type);
  if (known == nullptr) return nullptr;
  for (std::size_t at = known->schema.find('#'); at != std::string_view::npos; at = known->schema.find('#', at + 1)) {
    const std::string_view name = known->schema.substr(at + 1, known->schema.find('"', at) - at - 1);
    if (const Object* const object = keys::find_object(name)) return object;
  }
  return nullptr;
}

// "light" of "[light]" and of "{light}".
std::string_view item_of(std::string_view type) { return type.substr(1, type.size() - 2); }

bool is_a_part(const Element& element) { return element.kind() == Kind::object && element.find("value").has_value(); }

// The type of an element by its way from the root, "" where the tables do not know it; its key, of those that have one.
struct Described {
  std::string_view type;
  const Key* key = nullptr;
};

Described described(const Element& element) {
  const auto parent = element.parent();
  if (!parent) {
    if (element.find("joints") || element.find("from")) return {"model"};
    return {element.find("camera") || element.find("actors") || element.find("frames") ? "film" : ""};
  }
  const Described above = described(*parent);
  if (above.type.empty()) return {};
  if (above.type.front() == '[' || above.type.front() == '{') return {item_of(above.type)};
  if (is_a_part(*parent) && element.key() == "value") return above;
  const Object* const object = is_a_part(*parent) ? &keys::object("part") : object_in(above.type);
  const Key* const key = object == nullptr ? nullptr : object->find(element.key());
  return key == nullptr ? Described{} : Described{key->type, key};
}

// Of an object of another file: the first key of this name that the tables have.
Described named(std::string_view key) {
  for (const auto objects : {keys::film_objects(), keys::model_objects()})
    for (const Object& object : objects)
      if (const Key* const found = object.find(key)) return {found->type, found};
  return {};
}

std::string example_of(const Described& what) {
  if (what.key != nullptr) {
    if (!what.key->example.empty()) return std::string(what.key->example);
    if (!what.key->json.empty()) return std::string(what.key->json);
    if (what.key->number) return shown(*what.key->number);
  }
  if (const keys::Type* const type = keys::find_type(what.type)) return std::string(type->example);
  const Object* const object = what.type.empty() ? nullptr : keys::find_object(what.type);
  return object == nullptr ? "" : std::string(object->example);
}

// Within a part of a film's key, which are written as the part is without them.
bool in_a_part(std::string_view key) { return key == "value" || key == "in" || key == "out"; }

}  // namespace

std::string form_of(const Element& element) {
  std::optional<Element> keyed = element;
  while (keyed && keyed->key().empty()) keyed = keyed->parent();
  if (!keyed) return "";
  const std::string_view key = keyed->key();
  if (const auto part = keyed->parent(); in_a_part(key) && part && part->parent()) keyed = part;
  Described what = described(*keyed);
  if (what.type.empty()) what = named(keyed->key());
  const std::string example = example_of(what);
  return example.empty() ? "" : "\"" + std::string(key) + "\": " + example;
}

}  // namespace mars::document
