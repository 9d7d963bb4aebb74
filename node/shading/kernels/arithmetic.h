// Powers and the exponential, with + - * / and square roots only.
#pragma once

#include "node/shading/kernels/block.h"

namespace mars::shading::MARS_SET {

// square ^ (exponent / 2), square in 0..1, by squarings and square roots; the exponent counts to 1/256.
inline Floats raise(Floats square, float exponent) {
  const auto fixed = static_cast<std::uint32_t>(exponent * 256.0f + 0.5f);
  Floats power = hn::IfThenElseZero(hn::Gt(square, zero()), constant(1.0f));  // no light is none at exponent 0 too
  Floats root = square;
  std::uint32_t rest = fixed & 511;
  for (std::uint32_t bit = 256; rest != 0; bit >>= 1) {
    root = hn::Sqrt(root);
    if (rest & bit) power = hn::Mul(power, root);
    rest &= ~bit;
  }
  for (std::uint32_t whole = fixed >> 9; whole != 0; whole >>= 1) {
    if (whole & 1) power = hn::Mul(power, square);
    square = hn::Mul(square, square);
  }
  return power;
}

inline Floats fifth_power(Floats x) {
  const Floats square = hn::Mul(x, x);
  return hn::Mul(hn::Mul(square, square), x);
}

// e^-x for x >= 0, to 5e-7 of itself; from 80 on as if x were 80. With k the nearest whole number to x / ln 2, this is
// 2^-k e^y, |y| < 0.35: its exponent's bits for the first factor, Taylor's polynomial of degree 6 for the second. ln 2
// is taken in two parts, the first of so few bits that its product with k is exact (W. J. Cody, W. Waite, "Software
// manual for the elementary functions", 1980).
inline Floats exp_of_minus(Floats x) {
  constexpr float kPerLn2 = 1.44269504f, kLn2First = 0.693359375f, kLn2Rest = -2.12194440e-4f;
  const Floats near = hn::Min(x, constant(80.0f));
  const Floats k = hn::Floor(hn::Add(hn::Mul(near, constant(kPerLn2)), constant(0.5f)));
  const Floats y = hn::Add(hn::Sub(hn::Mul(k, constant(kLn2First)), near), hn::Mul(k, constant(kLn2Rest)));
  constexpr float kFactors[] = {1.0f / 720, 1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1, 1};
  Floats sum = constant(kFactors[0]);
  for (int i = 1; i < 7; ++i) sum = hn::Add(hn::Mul(sum, y), constant(kFactors[i]));
  const Ints down = hn::ShiftLeft<23>(hn::ConvertTo(kInts, k));
  return hn::BitCast(kFloats, hn::Sub(hn::BitCast(kInts, sum), down));
}

}  // namespace mars::shading::MARS_SET
