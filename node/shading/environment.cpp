#include "node/shading/environment.h"

#include <algorithm>
#include <cmath>

namespace mars::shading {
namespace {

constexpr int kCircle = 32;   // directions round the normal; only half of them, which mirror the others
constexpr int kHeights = 48;  // and away from it
constexpr double kLeastAlpha = 0.0064;
constexpr double kLeastCosine = 1.0 / 64;  // of the view: at 0 nothing is reflected evenly

// Cosines of (i + 1/2) / kCircle of a full turn, by turning again and again.
struct Circle {
  double cosine[kCircle / 2];

  Circle() {
    constexpr double kCos = 0.98078528040323044913, kSin = 0.19509032201612826785;  // of a turn / 32
    double c = 0.99518472667219688624, s = 0.09801714032956060199;                  // of a turn / 64
    for (double& out : cosine) {
      out = c;
      const double next = c * kCos - s * kSin;
      s = s * kCos + c * kSin;
      c = next;
    }
  }
};

struct Shares {
  double colored = 0, white = 0;
};

// H is distributed as D (N.H) says: its cosine's square is (1 - u) / (1 + (alpha^2 - 1) u) for u evenly in 0..1. Then
// the sum of F G (V.H) / ((N.H) (N.V)) is what is reflected, F split into its colour's share and white's.
Shares reflected(double nv, double alpha, const Circle& circle) {
  const double alpha2 = alpha * alpha, side = std::sqrt(1 - nv * nv);
  Shares sum;
  for (int j = 0; j < kHeights; ++j) {
    const double u = (j + 0.5) / kHeights;
    const double square = (1 - u) / (1 + (alpha2 - 1) * u), nh = std::sqrt(square), across = std::sqrt(1 - square);
    for (const double cosine : circle.cosine) {
      const double vh = side * across * cosine + nv * nh;
      const double nl = 2 * vh * nh - nv;
      if (vh <= 0 || nl <= 0) continue;
      const double shadow =
          nl * std::sqrt(nv * nv * (1 - alpha2) + alpha2) + nv * std::sqrt(nl * nl * (1 - alpha2) + alpha2);
      const double weight = 2 * nl * vh / (shadow * nh);
      const double rest = 1 - vh, grazing = rest * rest * rest * rest * rest;
      sum.colored += (1 - grazing) * weight;
      sum.white += grazing * weight;
    }
  }
  constexpr double kCount = kHeights * (kCircle / 2);
  return {sum.colored / kCount, sum.white / kCount};
}

EnvironmentTable make_table() {
  constexpr int kSide = EnvironmentTable::kSide;
  const Circle circle;
  EnvironmentTable table;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double rough = row / (kSide - 1.0);
      const Shares shares =
          reflected(std::max(column / (kSide - 1.0), kLeastCosine), std::max(rough * rough, kLeastAlpha), circle);
      table.colored[row * kSide + column] = static_cast<float>(shares.colored);
      table.white[row * kSide + column] = static_cast<float>(shares.white);
    }
  return table;
}

}  // namespace

const EnvironmentTable& environment_table() {
  static const EnvironmentTable table = make_table();
  return table;
}

}  // namespace mars::shading
