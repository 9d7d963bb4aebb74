// Nodes' code counts frames for forecasts.
#pragma once

#include "host/experiments/forecast/counter.h"

namespace mars::programs {

std::unique_ptr<forecast::Counter> make_node_counter(const wire::PackedFilm& film, forecast::Lines lines);

}  // namespace mars::programs
