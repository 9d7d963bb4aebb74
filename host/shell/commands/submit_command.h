// `mars submit`: a job of a batch system that renders.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_submit(cli::Command app);

}  // namespace mars::commands
