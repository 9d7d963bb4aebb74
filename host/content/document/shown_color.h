// One channel of a colour, 0 to 1, as people write it and screens show it, and as an amount of light: sRGB
// (IEC 61966-2-1).
#pragma once

#include "host/content/elementary/elementary.h"

namespace mars::document {

inline double light_of_shown(double shown) {
  return shown <= 0.04045 ? shown / 12.92 : elementary::pow((shown + 0.055) / 1.055, 2.4);
}

inline double shown_of_light(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * elementary::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace mars::document
