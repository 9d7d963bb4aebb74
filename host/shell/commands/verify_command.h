// `mars verify`: whether a folder has all its frames.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

// `code` becomes the exit code where it is not 0.
void add_verify(CLI::App& app, int& code);

}  // namespace mars::commands
