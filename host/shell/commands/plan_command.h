// `mars plan`: what a rendering would take.
#pragma once

#include "host/experiments/forecast/counter.h"

namespace CLI {
class App;
}

namespace mars::commands {

void add_plan(CLI::App& app, const forecast::MakeCounter& make_counter);

}  // namespace mars::commands
