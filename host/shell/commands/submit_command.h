// `mars submit`: a job of Slurm that renders.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_submit(CLI::App& app);

}  // namespace mars::commands
