// Fortran's entry points of nx_global.h.
#include <algorithm>

#include "hal/nx/fortran.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"

using namespace mars::hal::fortran;

namespace {

// By way of long: what is left of a sum or product in 32 bits is the same.
void combine(void (*operation)(long*, long, long*), Integer x[], Integer n) {
  std::vector<long> wide = widen(x, n);
  std::vector<long> work(wide.size());
  operation(wide.data(), n, work.data());
  std::transform(wide.begin(), wide.end(), x, narrow);
}

}  // namespace

extern "C" {

void gsync_() { gsync(); }

void gdsum_(double x[], const Integer* n, double work[]) { gdsum(x, *n, work); }
void gdhigh_(double x[], const Integer* n, double work[]) { gdhigh(x, *n, work); }
void gisum_(Integer x[], const Integer* n, Integer*) { combine(gisum, x, *n); }

void gcol_(const void* x, const Integer* xlen, void* y, const Integer* ylen, Integer* ncnt) {
  long all = 0;
  gcol(x, *xlen, y, *ylen, &all);
  *ncnt = narrow(all);
}
void gcolx_(const void* x, const Integer xlens[], void* y) { gcolx(x, widen(xlens, numnodes()).data(), y); }

}  // extern "C"
