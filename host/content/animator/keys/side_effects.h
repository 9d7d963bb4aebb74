// What a change of keys does besides what a person asked for: turns that go another way than their numbers say.
#pragma once

#include <string>
#include <vector>

#include "host/content/animator/keys/things.h"
#include "host/content/animator/keys/tracks.h"

namespace mars::animator {

// Lines about `chosen`, whose keys were `before` and are `after`; of what was so before, nothing. The thing's
// parts still have the values from before.
std::vector<std::string> side_effects(const Chosen& chosen, const Tracks& before, const Tracks& after);

}  // namespace mars::animator
