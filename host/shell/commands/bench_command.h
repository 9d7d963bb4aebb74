// `mars bench`: benchmarks, where MARS was built from its sources.
#pragma once

#include <vector>

namespace CLI {
class App;
}

namespace mars::commands {

// Takes from `command_line` the words after the name of a benchmark: it reads them itself.
void add_bench(CLI::App& app, std::vector<const char*>& command_line);

}  // namespace mars::commands
