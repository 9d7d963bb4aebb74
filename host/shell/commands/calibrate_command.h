// `mars calibrate`: what work and messages cost on this machine, as a platform.
#pragma once

#include <functional>

#include "host/experiments/message_costs.h"

namespace CLI {
class App;
}

namespace mars::commands {

// Measures messages between two nodes on this machine.
using MeasureMessages = std::function<experiments::MessageCosts()>;

void add_calibrate(CLI::App& app, const MeasureMessages& measure_messages);

}  // namespace mars::commands
