// What a person asks of an action, from a command line or a script.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/document/fields.h"

namespace mars::motion {

// Parameter to its values, as they were typed.
class Arguments {
 public:
  using Values = std::map<std::string, std::vector<std::string>>;

  // `where` names the action for messages: "walk", or "play.script:7: walk".
  Arguments(Values values, std::string where) : values_(std::move(values)), where_(std::move(where)) {}

  bool has(std::string_view name) const { return values_.contains(std::string(name)); }
  std::optional<double> number(std::string_view name, document::Range range) const;
  double number(std::string_view name, double otherwise, document::Range range) const;
  std::uint32_t count(std::string_view name, std::uint32_t otherwise, std::uint32_t highest) const;
  std::optional<glm::dvec3> vector(std::string_view name) const;  // of two or three numbers, z then 0
  std::optional<std::string> word(std::string_view name) const;
  const std::vector<std::string>& values(std::string_view name) const { return values_.at(std::string(name)); }
  std::size_t choice(std::string_view name, std::size_t otherwise, std::span<const std::string_view> choices) const;

  const std::string& where() const { return where_; }
  [[noreturn]] void refuse(std::string_view name, const std::string& what, const std::string& remedy) const;

 private:
  double parsed(std::string_view name, const std::string& text, document::Range range) const;

  Values values_;
  std::string where_;
};

}  // namespace mars::motion
