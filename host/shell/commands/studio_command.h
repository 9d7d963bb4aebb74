// `mars studio`: a film or a model in the browser.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_studio(cli::Command app);

}  // namespace mars::commands
