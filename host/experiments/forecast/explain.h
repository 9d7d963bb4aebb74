// Explains a forecast by its walls (host/render/walls/walls.h): the same rendering, by as many groups and contributors,
// is rehearsed again on platforms where a wall takes no time.
#pragma once

#include <string>
#include <vector>

#include "host/experiments/forecast/forecast.h"
#include "host/render/walls/walls.h"

namespace mars::forecast {

// `forecast`: of the same counts, tasks and setting. `threads`: rehearsals at a time.
walls::Explanation explain(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting,
                           const Forecast& forecast, int threads);

// That the platform's costs of some of the film's work are not identified, and which; "" where all are.
std::string unidentified_text(const FilmCounts& counts, const Setting& setting);

// Where work and messages of the walls take no time. Unevenness is none of a platform's: it stays.
experiments::Platform without(experiments::Platform platform, walls::Walls walls, Writers writers);

}  // namespace mars::forecast
