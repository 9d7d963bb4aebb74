#include "hal/failure/failure.h"
#include "host/studio/run_studio.h"

namespace mars::studio {

void run_studio(const StudioSettings&) {
  throw Failure("this MARS was built without the studio, which needs Boost, OpenSSL, zlib and libjpeg-turbo", "",
                "run ./bootstrap, which installs them (Debian: libboost-dev libssl-dev zlib1g-dev libturbojpeg0-dev) "
                "and builds MARS again");
}

}  // namespace mars::studio
