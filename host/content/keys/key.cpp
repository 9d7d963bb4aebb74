#include "host/content/keys/key.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::keys {

std::vector<std::string_view> Object::typed_names() const {
  std::vector<std::string_view> typed;
  for (const Key& key : keys)
    if (key.typed) typed.push_back(key.name);
  return typed;
}

const Key* Object::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Key::name);
  return found == keys.end() ? nullptr : &*found;
}

const Key& Object::key(std::string_view key) const {
  const Key* const found = find(key);
  check(found != nullptr, "an object has the key that its reader asks for");
  return *found;
}

}  // namespace mars::keys
