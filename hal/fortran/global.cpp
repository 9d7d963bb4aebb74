// Fortran's entry points of nx_global.h.
#include <algorithm>
#include <vector>

#include "hal/fortran/fortran.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"

using namespace mars::fortran;

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
void gdprod_(double x[], const Integer* n, double work[]) { gdprod(x, *n, work); }
void gdhigh_(double x[], const Integer* n, double work[]) { gdhigh(x, *n, work); }
void gdlow_(double x[], const Integer* n, double work[]) { gdlow(x, *n, work); }
void gssum_(float x[], const Integer* n, float work[]) { gssum(x, *n, work); }
void gsprod_(float x[], const Integer* n, float work[]) { gsprod(x, *n, work); }
void gshigh_(float x[], const Integer* n, float work[]) { gshigh(x, *n, work); }
void gslow_(float x[], const Integer* n, float work[]) { gslow(x, *n, work); }
void gisum_(Integer x[], const Integer* n, Integer*) { combine(gisum, x, *n); }
void giprod_(Integer x[], const Integer* n, Integer*) { combine(giprod, x, *n); }
void gihigh_(Integer x[], const Integer* n, Integer*) { combine(gihigh, x, *n); }
void gilow_(Integer x[], const Integer* n, Integer*) { combine(gilow, x, *n); }
void giand_(Integer x[], const Integer* n, Integer*) { combine(giand, x, *n); }
void gior_(Integer x[], const Integer* n, Integer*) { combine(gior, x, *n); }
void gixor_(Integer x[], const Integer* n, Integer*) { combine(gixor, x, *n); }
void gland_(Integer x[], const Integer* n, Integer*) { combine(gland, x, *n); }
void glor_(Integer x[], const Integer* n, Integer*) { combine(glor, x, *n); }
void glxor_(Integer x[], const Integer* n, Integer*) { combine(glxor, x, *n); }

// A Fortran function of two arrays is called like a C function of two pointers.
void gopf_(void* x, const Integer* xlen, void* work, nx_operation function) { gopf(x, *xlen, work, function); }

void gcol_(const void* x, const Integer* xlen, void* y, const Integer* ylen, Integer* ncnt) {
  long all = 0;
  gcol(x, *xlen, y, *ylen, &all);
  *ncnt = narrow(all);
}
void gcolx_(const void* x, const Integer xlens[], void* y) { gcolx(x, widen(xlens, numnodes()).data(), y); }

void gsendx_(const Integer* type, const void* x, const Integer* xlen, const Integer nodes[], const Integer* n) {
  gsendx(*type, x, *xlen, widen(nodes, *n).data(), *n);
}

}  // extern "C"
