// `mars verify`: whether a folder has all its frames.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

// `code` becomes the exit code where it is not 0.
void add_verify(cli::Command app, int& code);

}  // namespace mars::commands
