#include "tests/hal/nx_bodies.h"

#include "hal/nx/nx_messages.h"

namespace mars::hal {

void meet() {
  constexpr long kHere = 999'000'001;
  constexpr long kGo = 999'000'002;
  if (mynode() == myhost()) {
    for (long node = 0; node < numnodes(); ++node) crecv(kHere, nullptr, 0);
    csend(kGo, nullptr, 0, -1, 0);
  } else {
    csend(kHere, nullptr, 0, myhost(), 0);
    crecv(kGo, nullptr, 0);
  }
}

}  // namespace mars::hal
