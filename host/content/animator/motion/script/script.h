// Scripts (thesis 3.2.3): lines that say which actor does what at which time; docs/motion.md has the form. A script is
// applied to a film, and again after it was changed: from its first cue of an actor on, the actor's keys are the
// script's.
#pragma once

#include <string>
#include <vector>

#include "host/content/animator/motion/script/action.h"

namespace mars::motion {

struct Played {
  std::uint32_t last = 0;           // frame at which the last action ends
  bool cut = false;                 // whether it said itself where the film ends
  std::vector<std::string> report;  // a line for each action: "play.script:4: anna walk, frames 10 to 82"
};

// Changes the film, or throws with the script's file and line; the film is then as it was. `path` is the
// film's, `name` the script's, for messages.
Played play_script(document::Json& film, const std::filesystem::path& path, const std::string& script,
                   const std::string& name);

}  // namespace mars::motion
