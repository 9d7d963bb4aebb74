// `mars render`: a film to frames.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_render(CLI::App& app);

}  // namespace mars::commands
