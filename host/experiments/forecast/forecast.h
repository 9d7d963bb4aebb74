// A forecast of a rendering: its seconds, memory and bytes on a platform, and with how many groups of nodes, how many
// nodes that draw a keyframe or an inbetween, and which cuts of intervals into tasks it is shortest. It follows from
// counted frames and the platform alone, so that it is the same every time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "host/experiments/forecast/film_counts.h"
#include "host/experiments/forecast/rehearsal.h"
#include "host/experiments/forecast/setting.h"

namespace mars::forecast {

// In seconds; a rendering takes that long with kWithin.
struct Interval {
  double low;
  double high;
};

struct Forecast {
  int nodes = 1;
  std::uint32_t groups = 1;
  Writers writers = Writers::host;            // of files
  std::int32_t contributors = 0;              // to a keyframe, as in farm::Plan
  std::int32_t sharers = 1;                   // of an inbetween, as in farm::Plan
  std::uint32_t most_frames = 0;              // of a task, as in farm::make_tasks
  Rehearsed run;                              // by the platform's costs
  std::optional<experiments::Spread> spread;  // of such forecasts
  double middle = 1;                          // of renderings' times over such forecasts, also where no spread is known

  double seconds() const { return run.seconds * middle; }
  std::optional<Interval> interval() const {
    return spread ? std::optional(Interval{run.seconds * spread->low, run.seconds * spread->high}) : std::nullopt;
  }
  double node_hours() const { return nodes * seconds() / 3600; }
};

// `tasks`: not cut. `groups`: 0: those that make the rendering shortest.
Forecast forecast(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting, int nodes,
                  std::uint32_t groups);

// Of what is done, how much of all.
using Progress = std::function<void(int done, int all)>;

// By numbers of nodes: powers of two below `most`, and `most`; in `groups`, as far as there are nodes, where they are
// given. `threads`: numbers at a time.
std::vector<Forecast> forecasts_up_to(const FilmCounts& counts, const std::vector<farm::Task>& tasks,
                                      const Setting& setting, int most, std::uint32_t groups, int threads,
                                      const Progress& progress = {});

}  // namespace mars::forecast
