// Typed reading of a document's elements, so that readers of films and models are tables of keys and ranges.
// Whatever does not fit is a Failure that names the element and says what would.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/content/document/document.h"
#include "host/content/document/text.h"
#include "host/content/keys/key.h"

namespace mars::document {

using keys::kFarthest;
using keys::Range;

// The keys an object may have.
struct Keys {
  std::string_view of;  // what the object is: "joint"
  std::span<const std::string_view> names;
  const keys::Object* object = nullptr;  // where it is one of film and model files

  constexpr Keys(std::string_view of, std::span<const std::string_view> names) : of(of), names(names) {}
  Keys(const keys::Object& object) : of(object.name), names(object.names), object(&object) {}
  Keys(const keys::Object&&) = delete;
};

double read_number(const Element& element, Range range = {});
std::uint32_t read_count(const Element& element, std::uint32_t lowest, std::uint32_t highest);
glm::dvec3 read_vector(const Element& element, Range range = {});
glm::dvec3 read_color(const Element& element);  // each part 0 to 1
std::string read_text(const Element& element);  // not empty

// Says why a file that a film or model names is of no use: "which does not exist". Empty if it is a regular file.
std::string file_trouble(const std::filesystem::path& path);

// The path of a file that the element names as seen from a folder (its document's): a regular file that is there.
std::filesystem::path read_file_name(const Element& element, const std::filesystem::path& folder);
std::filesystem::path read_file_name(const Element& element);

// The index of the text among `choices`.
std::size_t read_choice(const Element& element, std::span<const std::string_view> choices);

// The value of the key, a number, a whole number or a choice, by the range or the choices of the table.
double read_number(const Element& element, const keys::Key& key);
std::uint32_t read_count(const Element& element, const keys::Key& key);
std::size_t read_choice(const Element& element, const keys::Key& key);

void require_kind(const Element& element, Kind kind);
void require_size(const Element& element, std::size_t size);  // a list of `size` elements

// The name of `names` most like `wanted`, if any is near.
std::optional<std::string> near_name(std::string_view wanted, std::span<const std::string_view> names);

// "did you mean 'knee'?", or `otherwise` if no name is near.
std::string did_you_mean(std::string_view wanted, std::span<const std::string_view> names,
                         const std::string& otherwise);

// An object whose keys are all known.
class Fields {
 public:
  Fields(const Element& object, const Keys& keys);

  const Element& element() const { return object_; }
  std::optional<Element> find(std::string_view key) const { return object_.find(key); }
  Element required(std::string_view key) const;

  // What the table of an object says of one of its keys.
  const keys::Key& key(std::string_view name) const;

  // The key's value; where it is not there, the table's default, which lasts.
  Element value(std::string_view key) const;
  double number(std::string_view key) const;
  std::uint32_t count(std::string_view key) const;
  std::size_t choice(std::string_view key) const;
  bool flag(std::string_view key) const;
  glm::dvec3 vector(std::string_view key, Range range = {}) const;
  glm::dvec3 color(std::string_view key) const;

  // The key's value, or `otherwise` if it is not there.
  double number(std::string_view key, double otherwise, Range range = {}) const;
  std::uint32_t count(std::string_view key, std::uint32_t otherwise, std::uint32_t lowest, std::uint32_t highest) const;
  std::string text(std::string_view key, const std::string& otherwise) const;
  std::size_t choice(std::string_view key, std::size_t otherwise, std::span<const std::string_view> choices) const;

 private:
  Element object_;
  Keys keys_;
};

}  // namespace mars::document
