// `mars import`: a model from a mesh file or a patch file.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_import(CLI::App& app);

}  // namespace mars::commands
