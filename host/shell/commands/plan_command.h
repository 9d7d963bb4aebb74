// `mars plan`: what a rendering would take.
#pragma once

#include "host/cli/command.h"
#include "host/shell/commands/calibrate_command.h"

namespace mars::commands {

void add_plan(cli::Command app, const NodesCode& code);

}  // namespace mars::commands
