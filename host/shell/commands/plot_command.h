// `mars plot`: joint angles over time, drawn by gnuplot.
#pragma once

namespace CLI {
class App;
}

namespace mars::commands {

void add_plot(CLI::App& app);

}  // namespace mars::commands
