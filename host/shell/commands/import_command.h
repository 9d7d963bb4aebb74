// `mars import`: a model from a mesh file or a patch file.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_import(cli::Command app);

}  // namespace mars::commands
