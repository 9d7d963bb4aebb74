#include "host/experiments/forecast/forecast.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace mars::forecast {
namespace {

constexpr double kAlike = 1.01;  // times as long, a film
constexpr double kSoon = 0.75;   // times as long, a keyframe: much sooner, as messages may wait more than is forecast

constexpr int kLargeGroup = 128;  // nodes: larger ones are tried only where there are too few tasks for others

constexpr double kForever = std::numeric_limits<double>::infinity();

constexpr int kWorseInARow = 3;  // numbers of contributors, and fewer are not tried

// Both of as many nodes in as many groups. One that took too long to be better is not known to its end.
bool is_better(const Rehearsed& one, const Rehearsed& other) {
  if (one.seconds < other.seconds) return true;
  return one.seconds < kAlike * other.seconds && one.frames.front().seconds < kSoon * other.frames.front().seconds;
}

// The most first: it is often the best, and then others need not be played to their ends. All of the few, and between
// twice as many each time.
std::vector<int> numbers_of_groups(int most) {
  std::vector<int> numbers;
  for (int groups = 1; groups < most; groups = groups < 4 ? groups + 1 : 2 * groups) numbers.push_back(groups);
  numbers.push_back(most);
  std::ranges::reverse(numbers);
  return numbers;
}

// Keyframes by all nodes of a group, or by half as many, a quarter ... A host that takes strips slowly delays keyframes
// of many contributors much, but films little: inbetweens are drawn meanwhile.
Forecast with_groups(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting, int nodes,
                     int groups, double limit) {
  farm::Plan plan{tasks, farm::make_groups(nodes, groups, tasks.size()), 0};
  const auto rehearsed = [&](std::int32_t contributors) {
    plan.contributors = contributors;
    return Forecast{nodes,
                    static_cast<std::uint32_t>(plan.groups.size()),
                    setting.writers,
                    contributors,
                    rehearse(counts, plan, setting, nodes, limit),
                    experiments::spread_for(setting.platform.spread, nodes, setting.files),
                    experiments::middle_for(setting.platform.spread, nodes, setting.files)};
  };
  Forecast best = rehearsed(0);
  limit = std::min(limit, kAlike * best.run.seconds);
  int worse = 0;  // in a row
  for (std::int32_t fewer = plan.groups.front().count / 2; fewer >= 1 && worse < kWorseInARow; fewer /= 2) {
    Forecast next = rehearsed(fewer);
    ++worse;
    if (!is_better(next.run, best.run)) continue;
    best = std::move(next);
    limit = std::min(limit, kAlike * best.run.seconds);
    worse = 0;
  }
  return best;
}

}  // namespace

Forecast forecast(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting, int nodes,
                  std::uint32_t groups) {
  if (groups > 0) return with_groups(counts, tasks, setting, nodes, static_cast<int>(groups), kForever);
  const int most = std::min(nodes, static_cast<int>(tasks.size()));
  Forecast best;
  best.nodes = 0;
  const auto try_groups = [&](int some) {
    const double limit = best.nodes == 0 ? kForever : kAlike * best.run.seconds;
    Forecast next = with_groups(counts, tasks, setting, nodes, some, limit);
    if (best.nodes == 0 || next.run.seconds <= best.run.seconds) best = std::move(next);
  };
  for (const int some : numbers_of_groups(most))
    if (some == most || nodes / some <= kLargeGroup) try_groups(some);
  const auto coarse = static_cast<int>(best.groups);
  if (coarse > 4)
    for (const int some : {coarse * 3 / 4, std::min(most, coarse * 3 / 2)}) try_groups(some);
  return best;
}

std::vector<Forecast> forecasts_up_to(const FilmCounts& counts, const std::vector<farm::Task>& tasks,
                                      const Setting& setting, int most, std::uint32_t groups) {
  std::vector<Forecast> all;
  for (int nodes = 1; nodes < most; nodes *= 2)
    all.push_back(forecast(counts, tasks, setting, nodes, std::min(groups, static_cast<std::uint32_t>(nodes))));
  all.push_back(forecast(counts, tasks, setting, most, groups));
  return all;
}

}  // namespace mars::forecast
