// `mars status`, `mars watch` and `mars cancel`: what goes on in a folder of frames.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

// `code` becomes the exit code: 1 where mars watch ends and frames are missing.
void add_folder_commands(cli::Command app, int& code);

}  // namespace mars::commands
