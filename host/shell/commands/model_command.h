// `mars model`: make and change models step by step, at a terminal.
#pragma once

#include <vector>

#include "host/cli/command.h"

namespace mars::commands {

void add_model(cli::Command app);

// "mars model dog.json show", as it was written before version 0.2, becomes "mars model dog.json show", with a hint.
void put_model_first(std::vector<const char*>& words);

}  // namespace mars::commands
