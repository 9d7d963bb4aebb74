// `mars film`: films begun; their actors, lights, materials and settings changed.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_film(CLI::App& app);

}  // namespace mars::commands
