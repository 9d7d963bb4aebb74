// What files say of places in images and of colours of vertices, as models keep it.
#pragma once

#include <array>
#include <optional>

namespace mars::importer {

// A corner's place in an image and its colour, where the file gives these.
struct CornerPaint {
  std::optional<std::array<float, 2>> uv{};
  std::optional<std::array<float, 4>> color{};
};

// u and v; 0 where the file's are no numbers, or farther away than any model may have them.
std::array<float, 2> place_in_image(double u, double v);

// One part of a colour, 0 to 1 as shown, to four decimals: more than a byte holds. `is_light`: it is an amount of
// light.
float shown_part(double part, bool is_light);

}  // namespace mars::importer
