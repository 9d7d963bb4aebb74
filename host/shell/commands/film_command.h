// `mars film`: films begun; their actors, lights, materials and settings changed.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_film(cli::Command app);

}  // namespace mars::commands
