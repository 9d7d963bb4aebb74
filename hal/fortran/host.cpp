// Fortran's entry points of nx_host.h.
#include "hal/fortran/fortran.h"
#include "hal/nx/nx_host.h"

using namespace mars::fortran;

extern "C" {

void getcube_(const char* name, const char* type, const char* srm, const Integer* keep, CharacterLength name_length,
              CharacterLength type_length, CharacterLength srm_length) {
  getcube(text(name, name_length).c_str(), text(type, type_length).c_str(), text(srm, srm_length).c_str(), *keep);
}
void attachcube_(const char* name, CharacterLength length) { attachcube(text(name, length).c_str()); }
void relcube_(const char* name, CharacterLength length) { relcube(text(name, length).c_str()); }
void setpid_(const Integer* pid) { setpid(*pid); }
void load_(const char* file, const Integer* node, const Integer* pid, CharacterLength length) {
  load(text(file, length).c_str(), *node, *pid);
}
void waitall_(const Integer* node, const Integer* pid) { waitall(*node, *pid); }
void waitone_(const Integer* node, const Integer* pid, Integer* cnode, Integer* cpid, Integer* ccode) {
  long ended[3] = {};
  waitone(*node, *pid, &ended[0], &ended[1], &ended[2]);
  *cnode = narrow(ended[0]);
  *cpid = narrow(ended[1]);
  *ccode = narrow(ended[2]);
}
void killproc_(const Integer* node, const Integer* pid) { killproc(*node, *pid); }
void killcube_(const Integer* node, const Integer* pid) { killcube(*node, *pid); }

}  // extern "C"
