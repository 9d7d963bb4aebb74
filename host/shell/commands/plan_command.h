// `mars plan`: what a rendering would take.
#pragma once

#include "host/experiments/forecast/counter.h"
#include "host/shell/commands/calibrate_command.h"

namespace CLI {
class App;
}

namespace mars::commands {

void add_plan(CLI::App& app, const forecast::MakeCounter& make_counter, const MeasureMessages& measure_messages);

}  // namespace mars::commands
