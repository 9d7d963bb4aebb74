/* NX/2: messages, handlers and what a process knows of itself, as the iPSC/2 had them; for C, C++ and MARS
 * itself. Node ids are 0..numnodes()-1 and the host is myhost(); -1 is the wildcard for nodes and types.
 * Message types are 0..999,999,999, or 1,073,741,824..1,999,999,999 for "force" messages, which no wildcard
 * receive takes, no probe finds, and which are discarded when no receive is posted. Lengths are bytes. pid is
 * 0, or -1 where a wildcard makes sense. Between one sender and one receiver messages stay in order.
 *
 * A call that fails prints the reason and ends the program on all nodes. Its twin with an underscore before its
 * name returns -1 instead, with errno set (nx_errno.h), and 0 or more on success. In MARS's own C++ programs
 * the plain call throws mars::Failure. */
#pragma once

#include "nx_errno.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sends; returns when `buf` may be used again, not when it was received: messages are buffered, so that all
 * may send before they receive. (With the setting MARS_NX_STRICT a send of more than 100 bytes is done only when
 * its message has been received, for finding programs that rely on buffers; a process that then waits for
 * 5 s without any message, or until the job is ended, prints for which one.) node -1: to all other nodes, of the host
 * to all nodes. */
void csend(long type, const void* buf, long len, long node, long pid);
/* Waits for a message that `typesel` selects and receives it. typesel, of which 32 bits count: >= 0 that type;
 * -1 any ordinary type; another negative is a set of bits: bit k (0..29) selects type k, bit 30 every type from
 * 30 to 999,999,999. A message longer than `len` is EQMSGLONG and never cut: nothing is written to `buf`, and
 * the message is there for a longer receive. */
void crecv(long typesel, void* buf, long len);
/* Sends as csend, and waits for an answer as crecv; returns the answer's length. */
long csendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen);

/* Start a send, a receive or both and return a message id; buffers are the call's until the id is free. A
 * process has 65,536 ids: msgwait, msgdone that was 1, and msgcancel free them; EQNOMID when none is left. A
 * message goes to the first posted receive that selects it; one that is too short fails, not at once but at its
 * msgwait or msgdone, and the message goes on to the next. isendrecv is done when both are. A long message may still
 * be coming in when a short one behind it is there: receives of one sender's messages begin in order, and may end in
 * another. */
long isend(long type, const void* buf, long len, long node, long pid);
long irecv(long typesel, void* buf, long len);
long isendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen);
/* Waits for, or asks after (1 done, 0 not yet), what a message id stands for. */
void msgwait(long mid);
long msgdone(long mid);
/* Gives up what a message id stands for. A receive takes nothing any more; a message that it has already goes to
 * the next receive that selects it, or waits in its old place. A send is not called back: msgcancel returns when
 * the message has left its buffer, or is whole in a receive's. */
void msgcancel(long mid);

/* Waits for, or asks after (1 yes, 0 no), a message that could be received; info* then describe it. */
void cprobe(long typesel);
long iprobe(long typesel);

/* Throws away messages that have arrived and wait to be received: those that typesel selects, from `node`
 * and `pid`, -1 for any. Messages that posted receives have taken stay. */
void flushmsg(long typesel, long node, long pid);

/* About the message of this process's last receive, probe that found one, msgwait or msgdone == 1 of a receive. In a
 * handler: about its message; the program that it interrupts does not see it. */
long infocount(void);
long infonode(void);
long infotype(void);
long infopid(void);

/* Called with the message's type, length, sender (hsend: receiver, -1 for all), and its pid. */
typedef void (*nx_handler)(long type, long len, long node, long pid);
/* As isend, irecv and isendrecv; `proc` is called once, when the buffer is free again or holds its message
 * (hsendrecv: the answer), instead of an id. Handlers run inside message calls of the process, also of those that
 * wait and in global operations; with the setting MARS_NX_HANDLERS=thread between calls too, on another thread.
 * They run one at a time, in the order in which their messages arrived, and may make any call; what becomes due
 * meanwhile waits until the handler returns. A message too long for an hrecv fails the call in which the handler
 * would have run. */
void hsend(long type, const void* buf, long len, long node, long pid, nx_handler proc);
void hrecv(long typesel, void* buf, long len, nx_handler proc);
void hsendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen,
               nx_handler proc);
/* 1 holds handlers back until 0, though not their messages; returns what was before. masktrap(0) runs what is due. */
long masktrap(long state);

long mynode(void);
long numnodes(void);
long nodedim(void); /* the smallest d with 2^d >= numnodes() */
long mypid(void);
long myhost(void);
/* The Gray code of n, and the n whose Gray code it is. */
long gray(long n);
long ginv(long code);

unsigned long mclock(void); /* milliseconds since some fixed point */
double dclock(void);        /* seconds since some fixed point */
/* Ticks of a nanosecond since some fixed point; slow is the lower 32 bits. */
typedef struct esize {
  long slow;
  long shigh;
} esize_t;
void hwclock(esize_t* ticks);

void led(long state); /* 1: this node works, 0: it waits; shown by a debugger only */
void flick(void);     /* gives the processor away for a moment; longer the more often nothing has arrived */

/* The twins. */
long _csend(long type, const void* buf, long len, long node, long pid);
long _crecv(long typesel, void* buf, long len);
long _csendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen);
long _isend(long type, const void* buf, long len, long node, long pid);
long _irecv(long typesel, void* buf, long len);
long _isendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen);
long _msgwait(long mid);
long _msgdone(long mid);
long _msgcancel(long mid);
long _cprobe(long typesel);
long _iprobe(long typesel);
long _flushmsg(long typesel, long node, long pid);
long _infocount(void);
long _infonode(void);
long _infotype(void);
long _infopid(void);
long _hsend(long type, const void* buf, long len, long node, long pid, nx_handler proc);
long _hrecv(long typesel, void* buf, long len, nx_handler proc);
long _hsendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen,
                nx_handler proc);
long _masktrap(long state);
long _mynode(void);
long _numnodes(void);
long _nodedim(void);
long _mypid(void);
long _myhost(void);
long _led(long state);
long _flick(void);

#ifdef __cplusplus
}
#endif
