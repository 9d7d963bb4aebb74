// Where the tables are put together and looked up.
#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/keys/key.h"
#include "host/content/keys/objects.h"

namespace mars::keys {
namespace {

std::vector<Object> with_names(std::vector<Object> objects) {
  for (Object& object : objects)
    for (const Key& key : object.keys) object.names.push_back(key.name);
  return objects;
}

template <typename Item>
const Item* find_in(std::span<const Item> items, std::string_view name) {
  const auto found = std::ranges::find(items, name, &Item::name);
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

std::span<const Object> film_objects() {
  static const std::vector<Object> objects = with_names(make_film_objects());
  return objects;
}

std::span<const Object> model_objects() {
  static const std::vector<Object> objects = with_names(make_model_objects());
  return objects;
}

const Object* find_object(std::string_view name) {
  static const std::vector<Object> beside_files = with_names({shape_options()});
  for (const std::span<const Object> objects : {film_objects(), model_objects(), std::span(beside_files)})
    if (const Object* const found = find_in(objects, name)) return found;
  return nullptr;
}

const Object& object(std::string_view name) {
  const Object* const found = find_object(name);
  check(found != nullptr, "a reader asks for an object that there is");
  return *found;
}

const Range& range_of(std::string_view name, std::string_view key) { return object(name).key(key).range; }

const Type* find_type(std::string_view name) {
  const Type* const of_film = find_in(film_types(), name);
  return of_film != nullptr ? of_film : find_in(model_types(), name);
}

}  // namespace mars::keys
