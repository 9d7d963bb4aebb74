// `mars studio`.
#pragma once

#include "host/studio/studio_settings.h"

namespace mars::studio {

// Returns when a signal ended it. Throws Failure; where MARS was built without what the studio needs, at once.
void run_studio(const StudioSettings& settings);

}  // namespace mars::studio
