// `mars calibrate`: what work and messages cost on this machine, as a platform.
#pragma once

#include <functional>

#include "host/cli/command.h"
#include "host/experiments/message_costs.h"

namespace mars::commands {

// Measures messages between two nodes on this machine, where there is no MPI.
using MeasureMessages = std::function<experiments::MessageCosts()>;

// Where this machine is not calibrated, does so, and says so: true where what --platform here names is there then. The
// machine may be too busy for it.
bool calibrate_if_need_be(const MeasureMessages& measure_messages);

void add_calibrate(cli::Command app, const MeasureMessages& measure_messages);

}  // namespace mars::commands
