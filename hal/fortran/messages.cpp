// Fortran's entry points of nx_messages.h.
#include "hal/fortran/fortran.h"
#include "hal/nx/nx_messages.h"
#include "hal/nx/nx_paragon.h"

using namespace mars::fortran;

namespace {

using Handler = void (*)(const Integer* type, const Integer* length, const Integer* node, const Integer* pid);

// What NX calls for a subroutine, which gets its arguments by reference.
void call_handler(long type, long length, long node, long pid, long proc) {
  const Integer arguments[] = {narrow(type), narrow(length), narrow(node), narrow(pid)};
  reinterpret_cast<Handler>(proc)(&arguments[0], &arguments[1], &arguments[2], &arguments[3]);
}

}  // namespace

extern "C" {

void csend_(const Integer* type, const void* buf, const Integer* len, const Integer* node, const Integer* pid) {
  csend(*type, buf, *len, *node, *pid);
}
void crecv_(const Integer* typesel, void* buf, const Integer* len) { crecv(*typesel, buf, *len); }
Integer csendrecv_(const Integer* type, const void* sbuf, const Integer* slen, const Integer* node, const Integer* pid,
                   const Integer* typesel, void* rbuf, const Integer* rlen) {
  return narrow(csendrecv(*type, sbuf, *slen, *node, *pid, *typesel, rbuf, *rlen));
}
Integer isend_(const Integer* type, const void* buf, const Integer* len, const Integer* node, const Integer* pid) {
  return narrow(isend(*type, buf, *len, *node, *pid));
}
Integer irecv_(const Integer* typesel, void* buf, const Integer* len) { return narrow(irecv(*typesel, buf, *len)); }
Integer isendrecv_(const Integer* type, const void* sbuf, const Integer* slen, const Integer* node, const Integer* pid,
                   const Integer* typesel, void* rbuf, const Integer* rlen) {
  return narrow(isendrecv(*type, sbuf, *slen, *node, *pid, *typesel, rbuf, *rlen));
}
void cprobe_(const Integer* typesel) { cprobe(*typesel); }
Integer iprobe_(const Integer* typesel) { return narrow(iprobe(*typesel)); }
void flushmsg_(const Integer* typesel, const Integer* node, const Integer* pid) { flushmsg(*typesel, *node, *pid); }

Integer infocount_() { return narrow(infocount()); }
Integer infonode_() { return narrow(infonode()); }
Integer infotype_() { return narrow(infotype()); }
Integer infopid_() { return narrow(infopid()); }

void hsend_(const Integer* type, const void* buf, const Integer* len, const Integer* node, const Integer* pid,
            Handler proc) {
  hsendx(*type, buf, *len, *node, *pid, call_handler, reinterpret_cast<long>(proc));
}
void hrecv_(const Integer* typesel, void* buf, const Integer* len, Handler proc) {
  hrecvx(*typesel, buf, *len, -1, -1, call_handler, reinterpret_cast<long>(proc));
}
void hsendrecv_(const Integer* type, const void* sbuf, const Integer* slen, const Integer* node, const Integer* pid,
                const Integer* typesel, void* rbuf, const Integer* rlen, Handler proc) {
  hrecv_(typesel, rbuf, rlen, proc);
  csend(*type, sbuf, *slen, *node, *pid);
}
Integer masktrap_(const Integer* state) { return narrow(masktrap(*state)); }

Integer mynode_() { return narrow(mynode()); }
Integer numnodes_() { return narrow(numnodes()); }
Integer nodedim_() { return narrow(nodedim()); }
Integer mypid_() { return narrow(mypid()); }
Integer myhost_() { return narrow(myhost()); }
Integer gray_(const Integer* n) { return narrow(gray(*n)); }
Integer ginv_(const Integer* code) { return narrow(ginv(*code)); }

Integer mclock_() { return narrow(static_cast<long>(mclock())); }
double dclock_() { return dclock(); }
void hwclock_(Integer ticks[2]) {
  esize_t now;
  hwclock(&now);
  ticks[0] = narrow(now.slow);
  ticks[1] = narrow(now.shigh);
}

void led_(const Integer* state) { led(*state); }
void flick_() { flick(); }

}  // extern "C"
