// `mars plot`: joint angles over time, drawn by gnuplot.
#pragma once

#include "host/cli/command.h"

namespace mars::commands {

void add_plot(cli::Command app);

}  // namespace mars::commands
