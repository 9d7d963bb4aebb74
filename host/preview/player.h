// Plays pictures on a screen at their rate: those that cannot be shown in time are left out, so that time is always
// right. Handles keys.
#pragma once

#include "host/preview/screen.h"

namespace mars::preview {

// Until a person ends it. Returns the signal that ended it, 0: none.
int play(Pictures& pictures, Screen& screen);

}  // namespace mars::preview
