#include "host/content/animator/read_keys.h"

namespace mars::animator {

Ease read_ease(const document::Fields& fields) {
  constexpr std::string_view names[] = {"linear", "in", "out", "both"};
  constexpr Ease eases[] = {kLinear, kIn, kOut, kBoth};
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

}  // namespace mars::animator
