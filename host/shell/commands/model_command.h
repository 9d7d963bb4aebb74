// `mars model`: make and change models step by step, at a terminal.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_model(cli::Command app);

}  // namespace mars::commands
