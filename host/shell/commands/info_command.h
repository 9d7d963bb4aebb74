// `mars info`: what a film holds.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_info(CLI::App& app);

}  // namespace mars::commands
