// `mars animate`: a film's keys set, moved, timed, listed and checked from a terminal.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

// `code` becomes the exit code where it is not 0.
void add_animate(cli::Command app, int& code);

}  // namespace mars::commands
