// `mars calibrate`: what work and messages cost on this machine, as a platform.
#pragma once

#include <functional>

#include "host/cli/command.h"
#include "host/experiments/forecast/counter.h"
#include "host/experiments/message_costs.h"

namespace mars::commands {

// What of nodes' code a calibration needs, which only programs link.
struct NodesCode {
  std::function<experiments::MessageCosts()> measure_messages;  // between two nodes here, where there is no MPI
  forecast::MakeCounter make_counter;
};

// Where this machine is not calibrated, does so, and says so: true where what --platform here names is there then. The
// machine may be too busy for it.
bool calibrate_if_need_be(const NodesCode& code);

void add_calibrate(cli::Command app, const NodesCode& code);

}  // namespace mars::commands
