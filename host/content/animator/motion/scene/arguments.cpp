#include "host/content/animator/motion/scene/arguments.h"

#include <algorithm>
#include <cmath>

#include "hal/failure/failure.h"

namespace mars::motion {

void Arguments::refuse(std::string_view name, const std::string& what, const std::string& remedy) const {
  throw Failure("'" + std::string(name) + "' " + what, where_, remedy);
}

double Arguments::parsed(std::string_view name, const std::string& text, document::Range range) const {
  const double value = document::number_in<double>(text).value_or(NAN);
  if (!std::isfinite(value)) refuse(name, "is '" + text + "', which is no number", "write a number, as in 1.5");
  if (value < range.lowest || value > range.highest)
    refuse(name, "is " + text,
           "give a number from " + document::shown(range.lowest) + " to " + document::shown(range.highest));
  return value;
}

std::optional<double> Arguments::number(std::string_view name, document::Range range) const {
  const auto found = values_.find(std::string(name));
  if (found == values_.end()) return std::nullopt;
  return parsed(name, found->second.at(0), range);
}

double Arguments::number(std::string_view name, double otherwise, document::Range range) const {
  return number(name, range).value_or(otherwise);
}

std::uint32_t Arguments::count(std::string_view name, std::uint32_t otherwise, std::uint32_t highest) const {
  const double value = number(name, otherwise, {1, double(highest)});
  if (value != std::floor(value)) refuse(name, "is " + document::shown(value), "give a whole number");
  return static_cast<std::uint32_t>(value);
}

std::optional<glm::dvec3> Arguments::vector(std::string_view name) const {
  const auto found = values_.find(std::string(name));
  if (found == values_.end()) return std::nullopt;
  glm::dvec3 vector(0);
  for (std::size_t i = 0; i < found->second.size() && i < 3; ++i) vector[int(i)] = parsed(name, found->second[i], {});
  return vector;
}

std::optional<std::string> Arguments::word(std::string_view name) const {
  const auto found = values_.find(std::string(name));
  return found == values_.end() ? std::nullopt : std::optional(found->second.at(0));
}

std::size_t Arguments::choice(std::string_view name, std::size_t otherwise,
                              std::span<const std::string_view> choices) const {
  const auto found = values_.find(std::string(name));
  if (found == values_.end()) return otherwise;
  const auto at = std::find(choices.begin(), choices.end(), found->second.at(0));
  if (at != choices.end()) return static_cast<std::size_t>(at - choices.begin());
  refuse(name, "is '" + found->second.at(0) + "'",
         document::did_you_mean(found->second.at(0), choices, "one of " + document::joined(choices)));
}

}  // namespace mars::motion
