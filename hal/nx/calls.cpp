#include "hal/nx/nx_messages.h"

#include <chrono>

#include "hal/process.h"
#include "topology/hypercube.h"

using mars::hal::process;

extern "C" {

void csend(long type, const void* buf, long len, long node, long pid) {
  process().csend(type, buf, len, node, pid);
}
void crecv(long typesel, void* buf, long len) { process().crecv(typesel, buf, len); }
long isend(long type, const void* buf, long len, long node, long pid) {
  return process().isend(type, buf, len, node, pid);
}
long irecv(long typesel, void* buf, long len) { return process().irecv(typesel, buf, len); }
void msgwait(long mid) { process().msgwait(mid); }
long msgdone(long mid) { return process().msgdone(mid) ? 1 : 0; }
void cprobe(long typesel) { process().cprobe(typesel); }
long iprobe(long typesel) { return process().iprobe(typesel) ? 1 : 0; }

long infocount(void) { return static_cast<long>(process().info().length); }
long infonode(void) { return process().info().from; }
long infotype(void) { return process().info().type; }
long infopid(void) { return 0; }

long mynode(void) { return process().backend().rank(); }
long numnodes(void) { return process().backend().nodes(); }
long nodedim(void) { return mars::topology::dimension(process().backend().nodes()); }
long myhost(void) { return process().backend().host(); }

double dclock(void) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
unsigned long mclock(void) { return static_cast<unsigned long>(dclock() * 1000); }

void led(long state) { process().led(state != 0); }
void flick(void) { process().flick(); }

}  // extern "C"
