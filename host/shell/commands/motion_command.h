// `mars animate FILM walk|turn|sit|...|script`: actions that make keys, from a terminal.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace mars::commands {

// Adds a command for each action, and script. `film` is what stands before them, read when one of them runs.
void add_motion(CLI::App& animate, const std::string& film);

}  // namespace mars::commands
