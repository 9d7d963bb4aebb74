// Steps as pages send them.
#pragma once

#include "tests/fuzz/studio_pages.h"

namespace mars::fuzz {

// A page makes a view; then each step is previewed and committed.
Messages with_steps(const Messages& steps);

}  // namespace mars::fuzz
