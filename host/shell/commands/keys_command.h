// `mars keys`: what film and model files may hold.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_keys(CLI::App& app);

}  // namespace mars::commands
