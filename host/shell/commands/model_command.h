// `mars model`: make and change models step by step, at a terminal.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_model(CLI::App& app);

}  // namespace mars::commands
