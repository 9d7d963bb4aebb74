/* NX/2: byte order. The hosts of the iPSC/2 stored numbers with the highest byte first, its nodes with the lowest;
 * host programs turned what they sent (htoc: host to cube) and what they received (ctoh). Each works on `n`
 * elements of `array`, in place. Here the host and the nodes are machines of one kind: the calls are there, and
 * leave everything as it is. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

void htocs(short array[], long n);
void htocl(long array[], long n);
void htocf(float array[], long n);
void htocd(double array[], long n);
void ctohs(short array[], long n);
void ctohl(long array[], long n);
void ctohf(float array[], long n);
void ctohd(double array[], long n);

#ifdef __cplusplus
}
#endif
