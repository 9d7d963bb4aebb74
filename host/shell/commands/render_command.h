// `mars render`: a film to frames.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_render(cli::Command app);

}  // namespace mars::commands
