// A number as the sum of two doubles, of which the second is at most half a unit in the last place of the first: 106
// bits, where the compiler adds no product before it is rounded (-ffp-contract=off). Dekker, "A floating-point
// technique for extending the available precision", Numerische Mathematik 18 (1971).
#pragma once

#include <cfloat>
#include <cmath>

#ifdef __FAST_MATH__
#error "-ffast-math takes the low halves of pairs for zero"
#endif
static_assert(FLT_EVAL_METHOD == 0, "doubles must have no more bits than 53 while they are computed with");

namespace mars::elementary {

struct Pair {
  double high, low = 0;
};

// Exact where |a| >= |b|.
inline Pair sum_of_sorted(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

// Exact.
inline Pair sum_of(double a, double b) {
  const double high = a + b, part = high - a;
  return {high, (a - (high - part)) + (b - part)};
}

// Exact, of numbers below 2^996.
inline Pair product_of(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1;
  const double as = kSplit * a, bs = kSplit * b;
  const double a1 = as - (as - a), a2 = a - a1, b1 = bs - (bs - b), b2 = b - b1;
  const double high = a * b;
  return {high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2};
}

inline Pair operator-(Pair a) { return {-a.high, -a.low}; }

inline Pair operator+(Pair a, Pair b) {
  const Pair sum = sum_of(a.high, b.high);
  return sum_of_sorted(sum.high, sum.low + (a.low + b.low));
}

inline Pair operator-(Pair a, Pair b) { return a + -b; }

inline Pair operator*(Pair a, Pair b) {
  const Pair product = product_of(a.high, b.high);
  return sum_of_sorted(product.high, product.low + (a.high * b.low + a.low * b.high));
}

inline Pair operator/(Pair a, Pair b) {
  const double quotient = a.high / b.high;
  const Pair product = product_of(quotient, b.high);
  const double left = ((a.high - product.high) - product.low) + (a.low - quotient * b.low);
  return sum_of_sorted(quotient, left / b.high);
}

inline Pair root_of(Pair a) {
  if (a.high <= 0) return {std::sqrt(a.high)};
  const double root = std::sqrt(a.high);
  const Pair square = product_of(root, root);
  return sum_of_sorted(root, (((a.high - square.high) - square.low) + a.low) / (2 * root));
}

}  // namespace mars::elementary
