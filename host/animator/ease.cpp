#include "host/animator/ease.h"

namespace mars::host {
namespace {

double curve(double p1, double p2, double s) {
  const double r = 1 - s;
  return 3 * r * r * s * p1 + 3 * r * s * s * p2 + s * s * s;
}

}  // namespace

double eased(const Ease& ease, double time) {
  if (time <= 0) return 0;
  if (time >= 1) return 1;
  if (ease.x1 == ease.y1 && ease.x2 == ease.y2) return time;
  double low = 0, high = 1;
  for (int bit = 0; bit < 53; ++bit) {
    const double middle = (low + high) / 2;
    (curve(ease.x1, ease.x2, middle) < time ? low : high) = middle;
  }
  return curve(ease.y1, ease.y2, (low + high) / 2);
}

}  // namespace mars::host
