// Vectors of as many numbers as a packet of Embree's has rays, and what is done with them.
#pragma once

#include <cmath>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace mars::bench {

inline constexpr int kPacket = 16;
using Floats [[gnu::vector_size(4 * kPacket)]] = float;
using Ints [[gnu::vector_size(4 * kPacket)]] = int;

template <typename Vector, typename Number>
Vector got(const Number (&from)[kPacket]) {
  return *reinterpret_cast<const Vector*>(from);  // Embree aligns them
}

template <typename Vector, typename Number>
void put(Number (&to)[kPacket], Vector value) {
  *reinterpret_cast<Vector*>(to) = value;
}

// A bit for each that is true (negative).
inline unsigned mask_of(Ints truths) {
#ifdef __AVX512F__
  return _mm512_cmplt_epi32_mask(reinterpret_cast<__m512i>(truths), _mm512_setzero_si512());
#else
  unsigned mask = 0;
  for (int k = 0; k < kPacket; ++k) mask |= truths[k] < 0 ? 1u << k : 0u;
  return mask;
#endif
}

inline bool any(Ints truths) { return mask_of(truths) != 0; }

inline Floats inverse_root(Floats square) {
  for (int k = 0; k < kPacket; ++k) square[k] = 1 / std::sqrt(square[k]);
  return square;
}

}  // namespace mars::bench
