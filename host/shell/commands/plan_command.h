// `mars plan`: what a rendering would take.
#pragma once

#include "host/cli/command.h"
#include "host/experiments/forecast/counter.h"
#include "host/shell/commands/calibrate_command.h"

namespace mars::commands {

void add_plan(cli::Command app, const forecast::MakeCounter& make_counter, const MeasureMessages& measure_messages);

}  // namespace mars::commands
