// `mars compile`: a film's motion, computed once.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_compile(CLI::App& app);

}  // namespace mars::commands
