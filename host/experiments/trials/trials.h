// Forecasts are tried: mixed films are forecast and then rendered, with each of some numbers of nodes, without files
// and with them. No trial film was used to find the costs, so the ratios are as of any other film.
#pragma once

#include <functional>
#include <vector>

#include "host/experiments/forecast/counter.h"
#include "host/experiments/measured_run.h"
#include "host/experiments/platform.h"
#include "host/experiments/trials/trial_films.h"

namespace mars::trials {

struct TrialTask {
  std::vector<TrialFilm> films;  // as many as experiments::spread_of takes
  const experiments::Renderer& renderer;
  const experiments::Platform& platform;  // of this machine
  forecast::MakeCounter make_counter;
  std::function<void(int done, int all)> progress;
};

// The nodes for which forecasts are tried on a machine of `processors`.
std::vector<int> tried_nodes(int processors);

// Throws Failure where a rendering fails.
std::vector<experiments::Spread> try_forecasts(const TrialTask& task);

}  // namespace mars::trials
