/* The NX/2 message calls of the iPSC/2, as MARS and C programs of its time use them. Node ids are
 * 0..numnodes()-1 and the host is myhost(); -1 is the wildcard for nodes and types. Message types are
 * 0..999,999,999, or 1,073,741,824..1,999,999,999 for "force" messages, which no wildcard receive takes
 * and which are discarded when no receive is posted. Lengths are bytes. pid is 0, or -1 where a wildcard
 * makes sense. A call that fails ends the process after telling why (in C++: throws mars::Failure). */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/* Sends; returns when `buf` may be used again, not when it was received. node -1: to all other nodes. */
void csend(long type, const void* buf, long len, long node, long pid);
/* Waits for a message that `typesel` selects and receives it. Longer than `len` is an error, never cut.
 * typesel: >= 0 that type; -1 any ordinary type; another negative is a set of bits: bit k (0..29) selects
 * type k, bit 30 every type from 30 to 999,999,999. */
void crecv(long typesel, void* buf, long len);

/* Starts a send or receive and returns its message id; `buf` is the call's until msgwait or msgdone == 1. */
long isend(long type, const void* buf, long len, long node, long pid);
long irecv(long typesel, void* buf, long len);
/* Waits for, or asks after (1 done, 0 not yet), a message id; the id is free once done. */
void msgwait(long mid);
long msgdone(long mid);

/* Waits for, or asks after (1 yes, 0 no), a message that could be received; info* then describe it. */
void cprobe(long typesel);
long iprobe(long typesel);

/* About the message of this process's last receive, probe, msgwait or msgdone == 1. */
long infocount(void);
long infonode(void);
long infotype(void);
long infopid(void);

/* Collectives of all nodes (the host takes no part), called by all in the same order; results are left in
 * `x` on every node, `work` is as long as `x`. */
void gsync(void);
void gisum(long x[], long n, long work[]);
void gdsum(double x[], long n, double work[]);
void gdhigh(double x[], long n, double work[]);
/* Concatenation in node order. gcol: the bytes of all into `y` (room for `ylen`), their number into *ncnt.
 * gcolx: likewise, where every node already knows each node's length in bytes, xlens[numnodes()]. */
void gcol(const void* x, long xlen, void* y, long ylen, long* ncnt);
void gcolx(const void* x, const long xlens[], void* y);

long mynode(void);
long numnodes(void);
long nodedim(void); /* the smallest d with 2^d >= numnodes() */
long myhost(void);

unsigned long mclock(void); /* milliseconds since some fixed point */
double dclock(void);        /* seconds since some fixed point */

void led(long state); /* 1: this node works, 0: it waits; kept for whoever watches the process */
void flick(void);     /* gives the processor away for a moment; longer the more often nothing has arrived */

#ifdef __cplusplus
}
#endif
