// `mars keys`: what film and model files may hold.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_keys(cli::Command app);

}  // namespace mars::commands
