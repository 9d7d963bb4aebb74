// Typed reading of a document's elements, so that readers of films and models are tables of keys and ranges.
// Whatever does not fit is a Failure that names the element and says what would.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/content/document/document.h"
#include "host/content/document/text.h"

namespace mars::document {

inline constexpr double kFarthest = 1e9;  // of any coordinate or length, from the origin

struct Range {
  double lowest = -kFarthest;
  double highest = kFarthest;
};

// The keys an object may have. Named as in docs/schema, which a test compares with them.
struct Keys {
  const char* of;  // what the object is: "joint"
  std::span<const std::string_view> names;
};

double read_number(const Element& element, Range range = {});
std::uint32_t read_count(const Element& element, std::uint32_t lowest, std::uint32_t highest);
glm::dvec3 read_vector(const Element& element, Range range = {});
glm::dvec3 read_color(const Element& element);  // each part 0 to 1
std::string read_text(const Element& element);  // not empty

// The index of the text among `choices`.
std::size_t read_choice(const Element& element, std::span<const std::string_view> choices);

void require_kind(const Element& element, Kind kind);
void require_size(const Element& element, std::size_t size);  // a list of so many

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

  // The key's value, or `otherwise` if it is not there.
  double number(std::string_view key, double otherwise, Range range = {}) const;
  std::uint32_t count(std::string_view key, std::uint32_t otherwise, std::uint32_t lowest, std::uint32_t highest) const;
  glm::dvec3 vector(std::string_view key, const glm::dvec3& otherwise, Range range = {}) const;
  glm::dvec3 color(std::string_view key, const glm::dvec3& otherwise) const;
  std::string text(std::string_view key, const std::string& otherwise) const;
  std::size_t choice(std::string_view key, std::size_t otherwise, std::span<const std::string_view> choices) const;

 private:
  Element object_;
  const Keys& keys_;
};

}  // namespace mars::document
