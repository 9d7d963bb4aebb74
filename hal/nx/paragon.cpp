#include "hal/nx/nx_paragon.h"

#include <string>

#include "hal/messages/process.h"
#include "hal/nx/guard.h"

using mars::messages::process;
using mars::nx::plain;
using mars::nx::twin;

namespace {

void check_ptype(long ptype) {
  if (ptype == 0) return;
  process().fail("setptype", EQPID, "this process cannot have ptype " + std::to_string(ptype),
                 "every node runs one process, ptype 0");
}

}  // namespace

extern "C" {

long msginfo[8];

void crecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]) {
  plain([&] { process().crecvx(typesel, buf, len, nodesel, ptypesel, info); });
}
long _crecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]) {
  return twin([&] { process().crecvx(typesel, buf, len, nodesel, ptypesel, info); });
}
long irecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]) {
  return plain([&] { return process().irecvx(typesel, buf, len, nodesel, ptypesel, info); });
}
long _irecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, long info[8]) {
  return twin([&] { return process().irecvx(typesel, buf, len, nodesel, ptypesel, info); });
}
void cprobex(long typesel, long nodesel, long ptypesel, long info[8]) {
  plain([&] { process().cprobex(typesel, nodesel, ptypesel, info); });
}
long _cprobex(long typesel, long nodesel, long ptypesel, long info[8]) {
  return twin([&] { process().cprobex(typesel, nodesel, ptypesel, info); });
}
long iprobex(long typesel, long nodesel, long ptypesel, long info[8]) {
  return plain([&]() -> long { return process().iprobex(typesel, nodesel, ptypesel, info); });
}
long _iprobex(long typesel, long nodesel, long ptypesel, long info[8]) {
  return twin([&] { return process().iprobex(typesel, nodesel, ptypesel, info); });
}

void hsendx(long type, const void* buf, long len, long node, long ptype, nx_xhandler proc, long parameter) {
  plain([&] { process().hsend(type, buf, len, node, ptype, {.extended = proc, .parameter = parameter}); });
}
long _hsendx(long type, const void* buf, long len, long node, long ptype, nx_xhandler proc, long parameter) {
  return twin([&] { process().hsend(type, buf, len, node, ptype, {.extended = proc, .parameter = parameter}); });
}
void hrecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, nx_xhandler proc, long parameter) {
  plain([&] { process().hrecv(typesel, buf, len, nodesel, ptypesel, {.extended = proc, .parameter = parameter}); });
}
long _hrecvx(long typesel, void* buf, long len, long nodesel, long ptypesel, nx_xhandler proc, long parameter) {
  return twin(
      [&] { process().hrecv(typesel, buf, len, nodesel, ptypesel, {.extended = proc, .parameter = parameter}); });
}

long msgmerge(long mid1, long mid2) {
  return plain([&] { return process().msgmerge(mid1, mid2); });
}
long _msgmerge(long mid1, long mid2) {
  return twin([&] { return process().msgmerge(mid1, mid2); });
}
void msgignore(long mid) {
  plain([&] { process().msgignore(mid); });
}
long _msgignore(long mid) {
  return twin([&] { process().msgignore(mid); });
}

long infoptype(void) { return 0; }
long _infoptype(void) { return 0; }
long myptype(void) { return 0; }
long _myptype(void) { return 0; }
void setptype(long ptype) {
  plain([&] { check_ptype(ptype); });
}
long _setptype(long ptype) {
  return twin([&] { check_ptype(ptype); });
}

}  // extern "C"
