#include "host/experiments/forecast/forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "host/experiments/forecast/side_by_side.h"

namespace mars::forecast {
namespace {

constexpr double kAlike = 1.01;    // times as long, a film
constexpr double kSoon = 0.75;     // times as long, a keyframe: much sooner, as messages may wait more than is forecast
constexpr double kShorter = 0.98;  // times as long, a film whose intervals are cut, or its inbetweens shared

constexpr int kLargeGroup = 128;  // nodes: larger ones are tried only where there are too few tasks for others

// In a row that are worse, and fewer are not tried: numbers of contributors, of groups, of sharers.
constexpr int kWorseContributors = 3, kWorseGroups = 2, kWorseSharers = 2;

constexpr double kAlmost = 0.97;  // of a film's time: what takes that long decides it
constexpr double kUseless = 2;    // times as long as the best, a film: such a rehearsal is not played to its end

// Both of as many nodes in as many groups.
bool is_better(const Rehearsed& one, const Rehearsed& other) {
  if (kAlike * one.seconds < other.seconds) return true;
  if (kAlike * other.seconds < one.seconds) return false;
  if (one.frames.empty() || other.frames.empty()) return false;  // neither was played to the first frame
  const double key = one.frames.front().seconds, other_key = other.frames.front().seconds;
  return key < kSoon * other_key || (one.seconds < other.seconds && kSoon * key < other_key);
}

// Then it hardly matters what nodes do.
bool is_bound_by_host(const Rehearsed& run) { return run.host_busy > kAlmost * run.seconds; }

// Tasks, and what their frames have to be drawn.
struct Cut {
  std::vector<farm::Task> tasks;
  const FilmCounts* counts = nullptr;
  std::shared_ptr<const FilmCounts> own{};  // of pieces

  std::size_t longest() const {
    return std::ranges::max(tasks, {}, [](const farm::Task& task) { return task.frames.size(); }).frames.size();
  }
  // Of the task of an inbetween, on average.
  double inbetweens() const {
    double all = 0, squares = 0;
    for (const farm::Task& task : tasks) {
      const auto count = static_cast<double>(task.frames.size() - 1);
      all += count, squares += count * count;
    }
    return all > 0 ? squares / all : 0;
  }
};

Cut cut_into_pieces(const Cut& whole, std::uint32_t most_frames) {
  Cut cut{farm::cut_tasks(whole.tasks, most_frames)};
  if (cut.tasks.size() == whole.tasks.size()) return whole;
  cut.own = std::make_shared<FilmCounts>(cut_counts(*whole.counts, whole.tasks, cut.tasks));
  cut.counts = cut.own.get();
  return cut;
}

// The fastest of the ways to divide a film among `nodes` nodes.
class Search {
 public:
  Search(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting, int nodes)
      : whole_(cut_into_pieces({tasks, &counts}, setting.most_frames > 0 ? setting.most_frames : kUncut)),
        setting_(setting),
        nodes_(nodes) {}

  // `groups` 0: any number of them.
  Forecast best(std::uint32_t groups) {
    if (groups > 0)
      take(with_groups(0, static_cast<int>(groups)), 1);
    else
      try_groups();
    // Exact counts are of uncut tasks.
    if (setting_.most_frames == 0 && !whole_.counts->is_exact && !is_bound_by_host(best_->run)) try_cuts(groups);
    if (setting_.most_frames != kUncut && setting_.most_frames > 0) best_->most_frames = setting_.most_frames;
    return std::move(*best_);
  }

 private:
  const Cut& cut(std::uint32_t most_frames) {
    if (most_frames == 0) return whole_;
    auto [found, fresh] = cuts_.try_emplace(most_frames);
    if (fresh) found->second = cut_into_pieces(whole_, most_frames);
    return found->second;
  }

  bool take(Forecast next, double at_most) {
    if (best_ && next.run.seconds >= at_most * best_->run.seconds) return false;
    best_ = std::move(next);
    return true;
  }

  Forecast rehearsed(const Cut& cut, const farm::Plan& plan, double limit) const {
    KeyframeLoads loads;
    return rehearsed(cut, plan, limit, loads);
  }

  Forecast rehearsed(const Cut& cut, const farm::Plan& plan, double limit, KeyframeLoads& loads) const {
    return Forecast{nodes_,
                    static_cast<std::uint32_t>(plan.groups.size()),
                    setting_.writers,
                    plan.contributors,
                    plan.sharers,
                    0,
                    rehearse(*cut.counts, plan, setting_, nodes_, loads, limit),
                    experiments::spread_for(setting_.platform.spread, nodes_, setting_.files),
                    experiments::middle_for(setting_.platform.spread, nodes_, setting_.files)};
  }

  Forecast with_groups(std::uint32_t most_frames, int groups) {
    const Cut& cut = this->cut(most_frames);
    farm::Plan plan{cut.tasks, farm::make_groups(nodes_, groups, cut.tasks.size()), 0, std::max(setting_.sharers, 1)};
    // Of pieces keyframes are drawn as those of intervals.
    if (most_frames > 0) plan.contributors = std::min(best_->contributors, plan.groups.front().count);
    Forecast best = most_frames > 0 ? rehearsed(cut, plan, best_->run.seconds) : with_contributors(cut, plan);
    plan.contributors = best.contributors;
    if (setting_.sharers == 0 && !is_bound_by_host(best.run)) best = with_sharers(cut, plan, std::move(best));
    best.most_frames = most_frames;
    return best;
  }

  Forecast with_sharers(const Cut& cut, farm::Plan plan, Forecast best) const {
    int worse = 0;
    KeyframeLoads loads;
    for (const std::int32_t sharers : numbers_of_sharers(cut, plan.groups.front().count)) {
      plan.sharers = sharers;
      const double limit = std::min(best.run.seconds, best_ ? best_->run.seconds : best.run.seconds);
      Forecast next = rehearsed(cut, plan, limit, loads);
      if (next.run.seconds < kShorter * best.run.seconds)
        best = std::move(next), worse = 0;
      else if (++worse == kWorseSharers)
        break;
    }
    return best;
  }

  // Keyframes by all nodes of a group, or by half as many, a quarter ... A host that takes strips slowly delays
  // keyframes of many contributors much, but films little: inbetweens are drawn meanwhile. So fewer contributors are
  // tried also where the host binds the film.
  Forecast with_contributors(const Cut& cut, farm::Plan plan) const {
    const auto limit = [this](double own) { return std::min(own, best_ ? best_->run.seconds : own) * kUseless; };
    Forecast best = rehearsed(cut, plan, limit(std::numeric_limits<double>::infinity()));
    int worse = 0;  // in a row
    for (std::int32_t fewer = plan.groups.front().count / 2; fewer >= 1 && worse < kWorseContributors; fewer /= 2) {
      plan.contributors = fewer;
      Forecast next = rehearsed(cut, plan, limit(best.run.seconds));
      ++worse;
      if (!is_better(next.run, best.run)) continue;
      best = std::move(next);
      worse = 0;
    }
    return best;
  }

  // Of an inbetween, where nodes of a group may have none otherwise: as many as leave each team one of a task, or two
  // ...
  static std::vector<std::int32_t> numbers_of_sharers(const Cut& cut, int nodes) {
    const double inbetweens = cut.inbetweens();
    if (inbetweens == 0 || nodes < 2 || inbetweens >= 3 * nodes) return {};
    std::set<std::int32_t> numbers;
    for (const double turns : {1.0, 2.0, 3.0, 4.0, 8.0})
      numbers.insert(nodes / std::clamp(static_cast<std::int32_t>(std::ceil(inbetweens / turns)), 1, nodes));
    numbers.erase(1);
    return {numbers.begin(), numbers.end()};
  }

  // From the most on, which take the least time to try: half as many each time, and all of the last few.
  void try_groups() {
    const int most = std::min(nodes_, static_cast<int>(whole_.tasks.size()));
    const int fewest = std::min(most, (nodes_ + kLargeGroup - 1) / kLargeGroup);
    int worse = 0;
    for (int groups = most; groups >= fewest && worse < kWorseGroups; groups = groups <= 4 ? groups - 1 : groups / 2)
      worse = take(with_groups(0, groups), 1) ? 0 : worse + 1;
    const auto coarse = static_cast<int>(best_->groups);
    if (coarse > 4)
      for (const int some : {coarse * 3 / 4, std::min(most, coarse * 3 / 2)}) take(with_groups(0, some), 1);
  }

  // Into two pieces, three, four, six ... as long as that pays.
  void try_cuts(std::uint32_t groups) {
    const std::size_t longest = whole_.longest();
    const auto uncut = static_cast<int>(best_->groups);
    for (int pieces = 2; static_cast<std::size_t>(pieces) <= longest / 2; pieces += std::max(1, pieces / 2)) {
      const auto most_frames = static_cast<std::uint32_t>((longest + static_cast<std::size_t>(pieces) - 1) /
                                                          static_cast<std::size_t>(pieces));
      bool pays = false;
      for (const int some : groups > 0 ? std::set{static_cast<int>(groups)}
                                       : std::set{std::min(uncut, nodes_), std::min(uncut * pieces, nodes_)})
        pays |= take(with_groups(most_frames, some), kShorter);
      if (!pays) return;
    }
  }

  const Cut whole_;
  const Setting& setting_;
  const int nodes_;
  std::map<std::uint32_t, Cut> cuts_;  // by frames of a task, at most
  std::optional<Forecast> best_;
};

}  // namespace

Forecast forecast(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting, int nodes,
                  std::uint32_t groups) {
  return Search(counts, tasks, setting, nodes).best(groups);
}

std::vector<Forecast> forecasts_up_to(const FilmCounts& counts, const std::vector<farm::Task>& tasks,
                                      const Setting& setting, int most, std::uint32_t groups, int threads,
                                      const Progress& progress) {
  std::vector<int> numbers;
  for (int nodes = 1; nodes < most; nodes *= 2) numbers.push_back(nodes);
  numbers.push_back(most);
  std::vector<Forecast> all(numbers.size());
  std::mutex mutex;
  int done = 0;
  // Those of many nodes take longest: they begin first.
  side_by_side(numbers.size(), threads, [&](std::size_t turn) {
    const std::size_t i = numbers.size() - 1 - turn;
    all[i] = forecast(counts, tasks, setting, numbers[i], std::min(groups, static_cast<std::uint32_t>(numbers[i])));
    const std::scoped_lock lock(mutex);
    if (progress) progress(++done, static_cast<int>(numbers.size()));
  });
  return all;
}

}  // namespace mars::forecast
