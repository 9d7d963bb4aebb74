#include "host/experiments/forecast/forecast.h"

#include <algorithm>
#include <utility>

namespace mars::forecast {
namespace {

// All of the first few, then half as many more each time.
std::vector<int> numbers_of_groups(int most) {
  std::vector<int> numbers;
  for (int groups = 1; groups < most; groups += std::max(1, groups / 2)) numbers.push_back(groups);
  numbers.push_back(most);
  return numbers;
}

Forecast with_groups(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting, int nodes,
                     int groups) {
  const farm::Plan plan{tasks, farm::make_groups(nodes, groups, tasks.size())};
  return {nodes, static_cast<std::uint32_t>(plan.groups.size()), rehearse(counts, plan, setting, nodes)};
}

}  // namespace

Forecast forecast(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting, int nodes,
                  std::uint32_t groups) {
  if (groups > 0) return with_groups(counts, tasks, setting, nodes, static_cast<int>(groups));
  Forecast best;
  best.nodes = 0;
  for (const int some : numbers_of_groups(std::min(nodes, static_cast<int>(tasks.size())))) {
    Forecast next = with_groups(counts, tasks, setting, nodes, some);
    if (best.nodes == 0 || next.run.seconds < best.run.seconds) best = std::move(next);
  }
  return best;
}

std::vector<Forecast> forecasts_up_to(const FilmCounts& counts, const std::vector<farm::Task>& tasks,
                                      const Setting& setting, int most, std::uint32_t groups) {
  std::vector<Forecast> all;
  for (int nodes = 1; nodes < most; nodes *= 2) all.push_back(forecast(counts, tasks, setting, nodes, 0));
  all.push_back(forecast(counts, tasks, setting, most, groups));
  return all;
}

}  // namespace mars::forecast
