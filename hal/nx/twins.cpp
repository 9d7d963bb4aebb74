// The twins of calls.cpp.
#include "hal/messages/process.h"
#include "hal/nx/guard.h"
#include "hal/nx/nx_messages.h"
#include "hal/nx/pid.h"
#include "topology/hypercube.h"

using mars::messages::process;
using mars::nx::twin;

extern "C" {

long _csend(long type, const void* buf, long len, long node, long pid) {
  return twin([&] { process().csend(type, buf, len, node, pid); });
}
long _crecv(long typesel, void* buf, long len) {
  return twin([&] { process().crecv(typesel, buf, len); });
}
long _csendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen) {
  return twin([&] { return process().csendrecv(type, sbuf, slen, node, pid, typesel, rbuf, rlen); });
}
long _isend(long type, const void* buf, long len, long node, long pid) {
  return twin([&] { return process().isend(type, buf, len, node, pid); });
}
long _irecv(long typesel, void* buf, long len) {
  return twin([&] { return process().irecv(typesel, buf, len); });
}
long _isendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen) {
  return twin([&] { return process().isendrecv(type, sbuf, slen, node, pid, typesel, rbuf, rlen); });
}
long _msgwait(long mid) {
  return twin([&] { process().msgwait(mid); });
}
long _msgdone(long mid) {
  return twin([&] { return process().msgdone(mid); });
}
long _msgcancel(long mid) {
  return twin([&] { process().msgcancel(mid); });
}
long _cprobe(long typesel) {
  return twin([&] { process().cprobe(typesel); });
}
long _iprobe(long typesel) {
  return twin([&] { return process().iprobe(typesel); });
}
long _flushmsg(long typesel, long node, long pid) {
  return twin([&] { process().flushmsg(typesel, node, pid); });
}

long _hsend(long type, const void* buf, long len, long node, long pid, nx_handler proc) {
  return twin([&] { process().hsend(type, buf, len, node, pid, {.plain = proc}); });
}
long _hrecv(long typesel, void* buf, long len, nx_handler proc) {
  return twin([&] { process().hrecv(typesel, buf, len, -1, -1, {.plain = proc}); });
}
long _hsendrecv(long type, const void* sbuf, long slen, long node, long pid, long typesel, void* rbuf, long rlen,
                nx_handler proc) {
  return twin([&] { process().hsendrecv(type, sbuf, slen, node, pid, typesel, rbuf, rlen, {.plain = proc}); });
}
long _masktrap(long state) {
  return twin([&] { return process().masktrap(state != 0); });
}

long _infocount(void) {
  return twin([] { return process().info().length; });
}
long _infonode(void) {
  return twin([] { return process().info().from; });
}
long _infotype(void) {
  return twin([] { return process().info().type; });
}
long _infopid(void) { return 0; }

long _mynode(void) {
  return twin([] { return process().backend().rank(); });
}
long _numnodes(void) {
  return twin([] { return process().backend().nodes(); });
}
long _nodedim(void) {
  return twin([] { return mars::topology::dimension(process().backend().nodes()); });
}
long _mypid(void) { return mars::nx::own_pid; }
long _myhost(void) {
  return twin([] { return process().backend().host(); });
}
long _led(long state) {
  return twin([&] { process().led(state != 0); });
}
long _flick(void) {
  return twin([] { process().flick(); });
}

}  // extern "C"
