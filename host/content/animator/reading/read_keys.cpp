#include "host/content/animator/reading/read_keys.h"

#include <algorithm>

namespace mars::animator {
namespace {

constexpr auto kNames = [] {
  std::array<std::string_view, kNamedEases.size()> names;
  std::ranges::transform(kNamedEases, names.begin(), [](const auto& named) { return named.first; });
  return names;
}();

}  // namespace

void require_version_2(const document::Element& element) {
  const auto version = element.document().root().find("version");
  if (version && version->kind() == document::Kind::number && version->number() < 2)
    element.refuse("came with version 2 of the film format, but the film says \"version\": " +
                       document::shown(version->number()),
                   "write \"version\": 2, or leave version out");
}

Ease read_ease(const document::Fields& fields, const Ease& otherwise) {
  const auto element = fields.find("ease");
  if (!element) return otherwise;
  if (element->kind() != document::Kind::list) {
    const Ease ease = kNamedEases[document::read_choice(*element, kNames)].second;
    if (ease.spline || ease.hold) require_version_2(*element);
    return ease;
  }
  document::require_size(*element, 4);
  double numbers[4];
  std::size_t i = 0;
  for (const document::Element item : *element) {
    numbers[i] = document::read_number(item, i % 2 == 0 ? document::Range{0, 1} : document::Range{-10, 10});
    ++i;
  }
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

void read_slope(const document::Element& element, double& slope) { slope = document::read_number(element); }

void read_slope(const document::Element& element, glm::dvec2& slope) {
  document::require_size(element, 2);
  auto number = element.begin();
  slope.x = document::read_number(*number);
  slope.y = document::read_number(*++number);
}

void read_slope(const document::Element& element, glm::dvec3& slope) { slope = document::read_vector(element); }

void read_slope(const document::Element& element, Point& slope) { slope = {document::read_vector(element)}; }

}  // namespace mars::animator
