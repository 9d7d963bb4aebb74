// `mars studio`: a film or a model in the browser.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_studio(CLI::App& app);

}  // namespace mars::commands
