/* NX/2: global operations. All nodes call, in the same order, with equal lengths; the host takes no part.
 * Results are left in `x` on every node, with the same bits; `work` is as long as `x`. d is double, s float,
 * i long. Failures are as in nx_messages.h; what is wrong on one node, or different lengths (EQLEN), fails the
 * call on all. */
#pragma once

#include "nx_errno.h"

#ifdef __cplusplus
extern "C" {
#endif

void gsync(void); /* returns when all nodes have called it */

/* Element by element: sum, product, greatest, least. */
void gdsum(double x[], long n, double work[]);
void gdprod(double x[], long n, double work[]);
void gdhigh(double x[], long n, double work[]);
void gdlow(double x[], long n, double work[]);
void gssum(float x[], long n, float work[]);
void gsprod(float x[], long n, float work[]);
void gshigh(float x[], long n, float work[]);
void gslow(float x[], long n, float work[]);
void gisum(long x[], long n, long work[]);
void giprod(long x[], long n, long work[]);
void gihigh(long x[], long n, long work[]);
void gilow(long x[], long n, long work[]);
/* Bit by bit. */
void giand(long x[], long n, long work[]);
void gior(long x[], long n, long work[]);
void gixor(long x[], long n, long work[]);
/* Of truth values: not 0 is true; results are 0 or 1. */
void gland(long x[], long n, long work[]);
void glor(long x[], long n, long work[]);
void glxor(long x[], long n, long work[]);

/* A commutative and associative operation of one's own on `xlen` bytes: fn(x, work) leaves its result in x. */
typedef long (*nx_operation)(void* x, void* work);
void gopf(void* x, long xlen, void* work, nx_operation fn);

/* Concatenation in node order. gcol: the bytes of all into `y` (of `ylen` bytes), their number into *ncnt.
 * gcolx: as gcol, where every node already knows each node's length in bytes, xlens[numnodes()]. */
void gcol(const void* x, long xlen, void* y, long ylen, long* ncnt);
void gcolx(const void* x, const long xlens[], void* y);

/* Sends to each of nodes[0..n-1]; only the sender calls, receivers call crecv. */
void gsendx(long type, const void* x, long xlen, const long nodes[], long n);

/* The twins. */
long _gsync(void);
long _gdsum(double x[], long n, double work[]);
long _gdprod(double x[], long n, double work[]);
long _gdhigh(double x[], long n, double work[]);
long _gdlow(double x[], long n, double work[]);
long _gssum(float x[], long n, float work[]);
long _gsprod(float x[], long n, float work[]);
long _gshigh(float x[], long n, float work[]);
long _gslow(float x[], long n, float work[]);
long _gisum(long x[], long n, long work[]);
long _giprod(long x[], long n, long work[]);
long _gihigh(long x[], long n, long work[]);
long _gilow(long x[], long n, long work[]);
long _giand(long x[], long n, long work[]);
long _gior(long x[], long n, long work[]);
long _gixor(long x[], long n, long work[]);
long _gland(long x[], long n, long work[]);
long _glor(long x[], long n, long work[]);
long _glxor(long x[], long n, long work[]);
long _gopf(void* x, long xlen, void* work, nx_operation fn);
long _gcol(const void* x, long xlen, void* y, long ylen, long* ncnt);
long _gcolx(const void* x, const long xlens[], void* y);
long _gsendx(long type, const void* x, long xlen, const long nodes[], long n);

#ifdef __cplusplus
}
#endif
