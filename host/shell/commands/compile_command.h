// `mars compile`: a film's motion, computed once.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_compile(cli::Command app);

}  // namespace mars::commands
