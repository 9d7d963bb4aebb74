#include "hal/nx/nx_messages.h"

#include "hal/messages/process.h"
#include "hal/nx/guard.h"
#include "hal/nx/pid.h"
#include "topology/hypercube.h"

using mars::messages::process;
using mars::nx::plain;

extern "C" {

void csend(long type, const void* buf, long len, long node, long pid) {
  plain([&] { process().csend(type, buf, len, node, pid); });
}
void crecv(long typesel, void* buf, long len) {
  plain([&] { process().crecv(typesel, buf, len); });
}
long csendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen) {
  return plain([&] { return process().csendrecv(type, sbuf, slen, node, pid, typesel, rbuf, rlen); });
}
long isend(long type, const void* buf, long len, long node, long pid) {
  return plain([&] { return process().isend(type, buf, len, node, pid); });
}
long irecv(long typesel, void* buf, long len) {
  return plain([&] { return process().irecv(typesel, buf, len); });
}
long isendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen) {
  return plain([&] { return process().isendrecv(type, sbuf, slen, node, pid, typesel, rbuf, rlen); });
}
void msgwait(long mid) {
  plain([&] { process().msgwait(mid); });
}
long msgdone(long mid) {
  return plain([&]() -> long { return process().msgdone(mid); });
}
void msgcancel(long mid) {
  plain([&] { process().msgcancel(mid); });
}
void cprobe(long typesel) {
  plain([&] { process().cprobe(typesel); });
}
long iprobe(long typesel) {
  return plain([&]() -> long { return process().iprobe(typesel); });
}
void flushmsg(long typesel, long node, long pid) {
  plain([&] { process().flushmsg(typesel, node, pid); });
}

void hsend(long type, const void* buf, long len, long node, long pid, nx_handler proc) {
  plain([&] { process().hsend(type, buf, len, node, pid, {.plain = proc}); });
}
void hrecv(long typesel, void* buf, long len, nx_handler proc) {
  plain([&] { process().hrecv(typesel, buf, len, -1, -1, {.plain = proc}); });
}
void hsendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen,
               nx_handler proc) {
  plain([&] { process().hsendrecv(type, sbuf, slen, node, pid, typesel, rbuf, rlen, {.plain = proc}); });
}
long masktrap(long state) {
  return plain([&]() -> long { return process().masktrap(state != 0); });
}

long infocount(void) {
  return plain([] { return static_cast<long>(process().info().length); });
}
long infonode(void) {
  return plain([]() -> long { return process().info().from; });
}
long infotype(void) {
  return plain([]() -> long { return process().info().type; });
}
long infopid(void) { return 0; }

long mynode(void) {
  return plain([]() -> long { return process().backend().rank(); });
}
long numnodes(void) {
  return plain([]() -> long { return process().backend().nodes(); });
}
long nodedim(void) {
  return plain([]() -> long { return mars::topology::dimension(process().backend().nodes()); });
}
long mypid(void) { return mars::nx::own_pid; }
long myhost(void) {
  return plain([]() -> long { return process().backend().host(); });
}

// Of 31 bits, as NX's long had besides its sign.
long gray(long n) { return mars::topology::gray(static_cast<int>(n & 0x7fffffff)); }
long ginv(long code) { return mars::topology::inverse_gray(static_cast<int>(code & 0x7fffffff)); }

double dclock(void) { return mars::messages::seconds(); }
unsigned long mclock(void) { return static_cast<unsigned long>(dclock() * 1000); }
void hwclock(esize_t* ticks) {
  const auto count = static_cast<long long>(dclock() * 1e9);
  ticks->slow = static_cast<long>(count & 0xffffffff);
  ticks->shigh = static_cast<long>(count >> 32);
}

void led(long state) {
  plain([&] { process().led(state != 0); });
}
void flick(void) {
  plain([] { process().flick(); });
}

}  // extern "C"
