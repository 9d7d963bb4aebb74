#include "host/content/elementary/elementary.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "host/content/elementary/pair.h"

namespace mars::elementary {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Pair kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Pair kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// first + x (second + x (third ...))
template <std::size_t Count>
double polynomial(const std::array<double, Count>& factors, double x) {
  double sum = factors.back();
  for (std::size_t i = Count - 1; i-- > 0;) sum = factors[i] + x * sum;
  return sum;
}

// The nearest whole number, where |x| < 2^51.
double nearest(double x) {
  constexpr double kShift = 0x1.8p52;
  return (x + kShift) - kShift;
}

// An angle as a number of quarter turns (modulo 4) and a rest of at most half of one.
struct Reduced {
  int quarters;
  Pair rest;
};

// pi/2 in pieces of 33 bits: products with whole numbers below 2^20 are exact.
constexpr double kQuarterTurn[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69, 0x1.b839a252049c1p-104};
constexpr double kMostQuarters = 0x1p20;
constexpr double kMostCounted = 0x1p53;  // beyond it, nearest() finds no number of turns, and doubles are 2 apart

Reduced reduce_small(double angle, double further) {
  const double count = nearest(angle * (2 / kPi.high));
  Pair rest = sum_of(angle - count * kQuarterTurn[0], -count * kQuarterTurn[1]);
  rest = rest + sum_of(-count * kQuarterTurn[2], further - count * kQuarterTurn[3]);
  return {static_cast<int>(static_cast<std::int64_t>(count) & 3), rest};
}

Reduced reduce(double angle) {
  if (std::abs(angle) < kMostQuarters) return reduce_small(angle, 0);
  if (!std::isfinite(angle)) return {0, {kNan}};
  // fmod is exact: what it leaves out of 2 pi in each turn comes off afterwards.
  constexpr double kTurn = 2 * kPi.high;
  constexpr Pair kLeftOut{2 * kPi.low, -0x1.f1976b7ed8fbcp-108};
  const double within = std::fmod(angle, kTurn);
  if (std::abs(angle) > kMostCounted) return reduce_small(within, 0);
  const double turns = nearest((angle - within) / kTurn);
  const Pair rest = Pair{within} - Pair{turns} * kLeftOut;
  return reduce_small(rest.high, rest.low);
}

// Taylor's factors from the one of x^3 on.
constexpr double kThird = -1.0 / 6;
constexpr std::array kSine{1.0 / 120,
                           -1.0 / 5040,
                           1.0 / 362880,
                           -1.0 / 39916800,
                           1.0 / 6227020800.0,
                           -1.0 / 1307674368000.0,
                           1.0 / 355687428096000.0};
constexpr std::array kCosine{1.0 / 24,          -1.0 / 720,           1.0 / 40320,           -1.0 / 3628800,
                             1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};

// Both take angles up to pi/4.
Pair sine_of(Pair angle) {
  const double x = angle.high, square = x * x, cube = square * x;
  const double curve = kThird * cube + (cube * square * polynomial(kSine, square) - 0.5 * square * angle.low);
  return sum_of_sorted(x, angle.low + curve);
}

Pair cosine_of(Pair angle) {
  const double x = angle.high;
  const Pair square = product_of(x, x);
  const Pair first = sum_of_sorted(1, -0.5 * square.high);
  const double curve = square.high * square.high * polynomial(kCosine, square.high) - x * angle.low;
  return sum_of_sorted(first.high, first.low + (curve - 0.5 * square.low));
}

Pair sine_of(Reduced angle) {
  const Pair sine = angle.quarters & 1 ? cosine_of(angle.rest) : sine_of(angle.rest);
  return angle.quarters & 2 ? -sine : sine;
}

Pair cosine_of(Reduced angle) { return sine_of(Reduced{angle.quarters + 1, angle.rest}); }

// Arc tangents of multiples of 1/8.
constexpr Pair kArcs[] = {{0, 0},
                          {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                          {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                          {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                          {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                          {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                          {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                          {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                          {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
constexpr std::array kArc{-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15};

// Takes 0 to 1: atan x = atan c + atan((x - c) / (1 + c x)).
Pair arc_of(Pair x) {
  const double eighths = nearest(8 * x.high), near = eighths / 8;
  const Pair rest = near == 0 ? x : (x - Pair{near}) / (Pair{1} + Pair{near} * x);
  const double square = rest.high * rest.high;
  const double curve = rest.high * square * polynomial(kArc, square);
  return kArcs[static_cast<int>(eighths)] + sum_of_sorted(rest.high, rest.low + curve);
}

// y / x where 0 <= y <= x, of numbers of any size: raised to where the products of Pairs are exact.
Pair quotient_of(Pair y, Pair x) {
  if (x.high == 0) return {0};
  if (x.high == kInfinity) return {y.high == kInfinity ? 1.0 : 0.0};
  if (x.high < 0x1p900 && y.high > 0x1p-900) return y / x;
  const int up = -std::ilogb(x.high);
  const auto raised = [up](Pair a) { return Pair{std::ldexp(a.high, up), std::ldexp(a.low, up)}; };
  return raised(y) / raised(x);
}

// The angle of a direction, neither of whose coordinates is NaN.
double angle_of(Pair y, Pair x) {
  const bool left = std::signbit(x.high), below = std::signbit(y.high);
  if (left) x = -x;
  if (below) y = -y;
  const bool steep = y.high > x.high || (y.high == x.high && y.low > x.low);
  if (steep) std::swap(x, y);
  Pair angle = arc_of(quotient_of(y, x));
  if (steep) angle = kHalfPi - angle;
  if (left) angle = kPi - angle;
  return below ? -angle.high : angle.high;
}

constexpr Pair kBinaryLog{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};  // of e
constexpr double kLog2[] = {0x1.62e42fefp-1, 0x1.473de6af278edp-34, 0x1.cc01f97b57a08p-87};
constexpr std::array kPower{1.0 / 6,        1.0 / 24,          1.0 / 120,          1.0 / 720,
                            1.0 / 5040,     1.0 / 40320,       1.0 / 362880,       1.0 / 3628800,
                            1.0 / 39916800, 1.0 / 479001600.0, 1.0 / 6227020800.0, 1.0 / 87178291200.0};

// e^x times a power of two.
double power_of(Pair x, double binary) {
  const Pair square = product_of(x.high, x.high);
  const double curve = x.high * square.high * polynomial(kPower, x.high) + (x.low + x.low * x.high);
  const Pair sum = Pair{1} + (Pair{x.high} + Pair{square.high / 2, square.low / 2});
  return std::ldexp(sum.high + (sum.low + curve), static_cast<int>(binary));
}

double exp(Pair x) {
  if (std::isnan(x.high)) return kNan;
  if (x.high > 710) return kInfinity;
  if (x.high < -746) return 0;
  const double count = nearest(x.high * kBinaryLog.high);
  const Pair rest = sum_of(x.high - count * kLog2[0], -count * kLog2[1]);
  return power_of(rest + Pair{x.low}, count);
}

constexpr std::array kLog{2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11, 2.0 / 13, 2.0 / 15,
                          2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23, 2.0 / 25};

// The natural logarithm: 2 artanh((x - 1) / (x + 1)) of x between the roots of 1/2 and 2.
Pair log_of(double x) {
  int binary = 0;
  x = std::frexp(x, &binary);
  if (x < 0.70710678118654752) x *= 2, --binary;
  const Pair ratio = Pair{x - 1} / sum_of(x, 1), square = ratio * ratio;
  const Pair cube = ratio * square * (Pair{2} / Pair{3});
  const double rest = ratio.high * square.high * square.high * polynomial(kLog, square.high);
  const Pair log = Pair{2 * ratio.high, 2 * ratio.low} + (cube + Pair{rest});
  return Pair{binary * kLog2[0]} + (sum_of(binary * kLog2[1], binary * kLog2[2]) + log);
}

bool is_whole(double x) { return std::trunc(x) == x; }
bool is_odd(double x) { return std::abs(std::fmod(x, 2)) == 1; }

}  // namespace

double sin(double angle) { return sine_of(reduce(angle)).high; }
double cos(double angle) { return cosine_of(reduce(angle)).high; }

double tan(double angle) {
  const Reduced reduced = reduce(angle);
  return (sine_of(reduced) / cosine_of(reduced)).high;
}

double asin(double x) {
  if (!(std::abs(x) <= 1)) return kNan;
  return angle_of({x}, root_of(Pair{1} - product_of(x, x)));
}

double acos(double x) {
  if (!(std::abs(x) <= 1)) return kNan;
  return angle_of(root_of(Pair{1} - product_of(x, x)), {x});
}

double atan(double x) { return atan2(x, 1); }

double atan2(double y, double x) { return std::isnan(x) || std::isnan(y) ? kNan : angle_of({y}, {x}); }

double exp(double x) { return exp(Pair{x}); }

double exp2(double x) {
  if (!(std::abs(x) < 1100)) return x > 0 ? kInfinity : x < 0 ? 0 : kNan;
  const double count = nearest(x);
  return power_of(Pair{x - count} * (Pair{1} / kBinaryLog), count);
}

double log10(double x) {
  if (!(x > 0)) return x == 0 ? -kInfinity : kNan;
  constexpr Pair kTenth{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};  // 1 / log 10
  return (log_of(x) * kTenth).high;
}

double pow(double base, double exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (std::isnan(base) || std::isnan(exponent)) return kNan;
  if (base == 0) return exponent > 0 ? 0 : kInfinity;
  if (base < 0) return !is_whole(exponent) ? kNan : is_odd(exponent) ? -pow(-base, exponent) : pow(-base, exponent);
  const Pair log = log_of(base);
  if (std::abs(log.high * exponent) > 1000) return log.high * exponent > 0 ? kInfinity : 0;
  return exp(log * Pair{exponent});
}

double hypot(double x, double y) { return root_of(product_of(x, x) + product_of(y, y)).high; }

double cbrt(double x) {
  if (x == 0 || std::isnan(x)) return x;
  const double size = std::abs(x), root = exp(log_of(size) / Pair{3});
  return x < 0 ? -root : root;
}

}  // namespace mars::elementary
