#include "host/content/animator/pose/ease.h"

#include <algorithm>
#include <cmath>

namespace mars::animator {
namespace {

double curve(double p1, double p2, double s) {
  const double r = 1 - s;
  return 3 * r * r * s * p1 + 3 * r * s * s * p2 + s * s * s;
}

bool straight(const Ease& ease) { return ease.x1 == ease.y1 && ease.x2 == ease.y2; }

// Where on the curve `time` is.
double parameter_at(const Ease& ease, double time) {
  double low = 0, high = 1;
  for (int bit = 0; bit < 53; ++bit) {
    const double middle = (low + high) / 2;
    (curve(ease.x1, ease.x2, middle) < time ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Two controls of one coordinate on either side of `s` (de Casteljau), scaled to 0..1.
struct Halves {
  double before1, before2, after1, after2;
};

Halves halves_of(double p1, double p2, double s) {
  const double a = s * p1, b = p1 + s * (p2 - p1), c = p2 + s * (1 - p2);
  const double ab = a + s * (b - a), bc = b + s * (c - b), at = ab + s * (bc - ab);
  return {a / at, ab / at, (bc - at) / (1 - at), (c - at) / (1 - at)};
}

bool writable(const Ease& ease) {
  const auto within = [](double number, double least, double most) { return number >= least && number <= most; };
  return within(ease.x1, 0, 1) && within(ease.x2, 0, 1) && within(ease.y1, -10, 10) && within(ease.y2, -10, 10);
}

}  // namespace

double eased(const Ease& ease, double time) {
  if (time <= 0) return 0;
  if (time >= 1) return 1;
  if (straight(ease)) return time;
  // All joints of a figure mostly ask the same.
  thread_local Ease asked = kLinear;
  thread_local double at = 0, answer = 0;
  if (ease == asked && time == at) return answer;
  asked = ease;
  at = time;
  return answer = curve(ease.y1, ease.y2, parameter_at(ease, time));
}

Swing swing_of(const Ease& ease) {
  Swing swing;
  // Where the derivative (1 - s)^2 p1 + 2 (1 - s) s (p2 - p1) + s^2 (1 - p2) is nothing.
  const double p1 = ease.y1, p2 = ease.y2;
  const double a = 3 * p1 - 3 * p2 + 1, b = p2 - 2 * p1, c = p1, root = std::sqrt(std::max(b * b - a * c, 0.0));
  const double q = -(b + std::copysign(root, b));
  for (const double s : {q / a, c / q}) {
    if (!(s > 0 && s < 1)) continue;
    swing.lowest = std::min(swing.lowest, curve(p1, p2, s));
    swing.highest = std::max(swing.highest, curve(p1, p2, s));
  }
  return swing;
}

std::optional<std::pair<Ease, Ease>> split(const Ease& ease, double time) {
  if (straight(ease)) return std::pair(kLinear, kLinear);
  const double s = parameter_at(ease, time);
  const Halves x = halves_of(ease.x1, ease.x2, s), y = halves_of(ease.y1, ease.y2, s);
  const auto in_time = [](double part) { return std::clamp(part, 0.0, 1.0); };  // but for rounding it is
  const Ease before{in_time(x.before1), y.before1, in_time(x.before2), y.before2};
  const Ease after{in_time(x.after1), y.after1, in_time(x.after2), y.after2};
  if (!writable(before) || !writable(after)) return std::nullopt;
  return std::pair(before, after);
}

Ease swinging(double anticipation, double overshoot) {
  Ease ease = kBoth;
  // Each control moves the other's extreme a little: a few rounds of bisection settle both.
  for (int round = 0; round < 20; ++round) {
    const auto settle = [&](double Ease::*control, double least, double most, auto too_far) {
      for (int bit = 0; bit < 50; ++bit) {
        ease.*control = (least + most) / 2;
        (too_far() ? most : least) = ease.*control;
      }
    };
    if (anticipation > 0) settle(&Ease::y1, 0, -10, [&] { return swing_of(ease).lowest < -anticipation; });
    if (overshoot > 0) settle(&Ease::y2, 1, 10, [&] { return swing_of(ease).highest > 1 + overshoot; });
  }
  return ease;
}

}  // namespace mars::animator
