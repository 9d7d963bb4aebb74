// `mars bench`: benchmarks, where MARS was built from its sources.
#pragma once

#include <vector>

#include "host/cli/command.h"

namespace mars::commands {

// Takes from `command_line` the words after the name of a benchmark: it reads them itself.
void add_bench(cli::Command app, std::vector<const char*>& command_line);

}  // namespace mars::commands
