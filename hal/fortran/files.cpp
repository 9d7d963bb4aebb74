// Fortran's entry points of nx_files.h. A file is a unit of OPEN, where gfortran's library, which knows its
// descriptor, is linked; else it is a descriptor.
#include "hal/fortran/fortran.h"
#include "hal/nx/nx_files.h"

using namespace mars::fortran;

extern "C" {

__attribute__((weak)) Integer _gfortran_fnum_i4(const Integer* unit);

}  // extern "C"

namespace {

int descriptor(const Integer* unit) { return _gfortran_fnum_i4 != nullptr ? _gfortran_fnum_i4(unit) : *unit; }

}  // namespace

extern "C" {

void cread_(const Integer* unit, void* buf, const Integer* len) { cread(descriptor(unit), buf, *len); }
void cwrite_(const Integer* unit, const void* buf, const Integer* len) { cwrite(descriptor(unit), buf, *len); }
Integer iread_(const Integer* unit, void* buf, const Integer* len) {
  return narrow(iread(descriptor(unit), buf, *len));
}
Integer iwrite_(const Integer* unit, const void* buf, const Integer* len) {
  return narrow(iwrite(descriptor(unit), buf, *len));
}
void iowait_(const Integer* id) { iowait(*id); }
Integer iodone_(const Integer* id) { return narrow(iodone(*id)); }
Integer iseof_(const Integer* unit) { return narrow(iseof(descriptor(unit))); }
void eseek_(const Integer* unit, const Integer offset[2], const Integer* whence, Integer place[2]) {
  const esize_t at = eseek(descriptor(unit), {offset[0], offset[1]}, *whence);
  place[0] = narrow(at.slow);
  place[1] = narrow(at.shigh);
}
Integer lsize_(const Integer* unit, const Integer* offset, const Integer* whence) {
  return narrow(lsize(descriptor(unit), *offset, *whence));
}
void setiomode_(const Integer* unit, const Integer* mode) { setiomode(descriptor(unit), *mode); }
Integer iomode_(const Integer* unit) { return narrow(iomode(descriptor(unit))); }

}  // extern "C"
