#include "host/content/importer/paint.h"

#include <algorithm>
#include <cmath>

#include "host/content/document/fields.h"
#include "host/content/document/shown_color.h"

namespace mars::importer {

std::array<float, 2> place_in_image(double u, double v) {
  const auto sound = [](double number) {
    return std::abs(number) <= document::kFarthest ? static_cast<float>(number) : 0.0f;
  };
  return {sound(u), sound(v)};
}

float shown_part(double part, bool is_light) {
  const double within = part >= 0 ? std::min(part, 1.0) : 0;
  const double shown = is_light ? document::shown_of_light(within) : within;
  return static_cast<float>(std::round(shown * 1e4) / 1e4);
}

}  // namespace mars::importer
