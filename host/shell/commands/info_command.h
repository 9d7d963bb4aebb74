// `mars info`: what a film holds.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_info(cli::Command app);

}  // namespace mars::commands
