#include "host/content/animator/read_keys.h"

namespace mars::animator {

Ease read_ease(const document::Fields& fields) {
  constexpr std::string_view names[] = {"linear", "in", "out", "both", "spline"};
  constexpr Ease eases[] = {kLinear, kIn, kOut, kBoth, kSpline};
  const auto element = fields.find("ease");
  if (!element) return kLinear;
  if (element->kind() != document::Kind::list) return eases[document::read_choice(*element, names)];
  document::require_size(*element, 4);
  double numbers[4];
  std::size_t i = 0;
  for (const document::Element item : *element) {
    numbers[i] = document::read_number(item, i % 2 == 0 ? document::Range{0, 1} : document::Range{-10, 10});
    ++i;
  }
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

glm::dvec3 read_slope(const document::Element& element, const glm::dvec3&) { return document::read_vector(element); }

glm::dvec2 read_slope(const document::Element& element, const glm::dvec2&) {
  document::require_size(element, 2);
  auto number = element.begin();
  const double first = document::read_number(*number);
  return {first, document::read_number(*++number)};
}

double read_slope(const document::Element& element, double) { return document::read_number(element); }

bool is_keyed_value(const document::Element& element) {
  return element.kind() == document::Kind::object && element.find("value");
}

}  // namespace mars::animator
