/* NX of the Paragon: what it added to the calls of the iPSC/2 (nx_messages.h). Receives and probes may choose the
 * sender, and describe the message in an array of the caller's. A node runs one process, whose ptype is 0. */
#pragma once

#include "nx_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

#define INVALID_PTYPE (-1)
#define FORCE_TYPE 0x40000000 /* the first of the force types */

/* As without the x, for messages from `nodesel` (-1: anyone) and `ptypesel` (0, or -1: any). They describe
 * the message: info[0] is its type, info[1] its length, info[2] its sender, info[3] its ptype, info[4..7] are 0.
 * irecvx fills `info` when its id is waited for or found done. `info` may be a null pointer. infocount() and the
 * other info calls describe the message, too. */
void crecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]);
long irecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]);
void cprobex(long typesel, long nodesel, long ptypesel, long info[8]);
long iprobex(long typesel, long nodesel, long ptypesel, long info[8]);
/* An array for programs that have none of their own. */
extern long msginfo[8];

/* As without the x; the handler gets `parameter`, too. */
typedef void (*nx_xhandler)(long type, long len, long node, long ptype, long parameter);
void hsendx(long type, const void* buf, long len, long node, long ptype, nx_xhandler proc, long parameter);
void hrecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, nx_xhandler proc, long parameter);

/* One id for two: done when both are; the other is free at once. Its info is that of the first receive among
 * them. Where one id is -1 the result is the other. */
long msgmerge(long mid1, long mid2);
/* Frees the id now; what it stands for goes on, and its buffer is the call's until it is done. */
void msgignore(long mid);

long infoptype(void); /* as infopid */
long myptype(void);   /* 0 */
void setptype(long ptype);

/* The twins. */
long _crecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]);
long _irecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]);
long _cprobex(long typesel, long nodesel, long ptypesel, long info[8]);
long _iprobex(long typesel, long nodesel, long ptypesel, long info[8]);
long _hsendx(long type, const void* buf, long len, long node, long ptype, nx_xhandler proc, long parameter);
long _hrecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, nx_xhandler proc, long parameter);
long _msgmerge(long mid1, long mid2);
long _msgignore(long mid);
long _infoptype(void);
long _myptype(void);
long _setptype(long ptype);

#ifdef __cplusplus
}
#endif
