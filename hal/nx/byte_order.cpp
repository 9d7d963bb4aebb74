#include "hal/nx/byte_order.h"

#include <cstddef>

#include "hal/nx/nx_byte_order.h"

namespace {

template <class Number>
void to_cube(Number array[], long n) {
  mars::nx::reorder(std::span(array, n > 0 ? static_cast<std::size_t>(n) : 0), mars::nx::kHostOrder,
                    mars::nx::kNodeOrder);
}

template <class Number>
void to_host(Number array[], long n) {
  mars::nx::reorder(std::span(array, n > 0 ? static_cast<std::size_t>(n) : 0), mars::nx::kNodeOrder,
                    mars::nx::kHostOrder);
}

}  // namespace

extern "C" {

void htocs(short array[], long n) { to_cube(array, n); }
void htocl(long array[], long n) { to_cube(array, n); }
void htocf(float array[], long n) { to_cube(array, n); }
void htocd(double array[], long n) { to_cube(array, n); }
void ctohs(short array[], long n) { to_host(array, n); }
void ctohl(long array[], long n) { to_host(array, n); }
void ctohf(float array[], long n) { to_host(array, n); }
void ctohd(double array[], long n) { to_host(array, n); }

}  // extern "C"
