#include "host/experiments/forecast/explain.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>

#include "hal/messages/message_types.h"
#include "host/experiments/forecast/frame_costs.h"
#include "host/experiments/forecast/side_by_side.h"
#include "host/render/walls/even.h"
#include "node/wire/protocol.h"

namespace mars::forecast {
namespace {

using walls::Wall;
using walls::Walls;
using wire::Work;

// Nodes that write files compose frames, too.
constexpr std::array kComposing{Work::host_run, Work::host_byte, Work::host_restored};
constexpr std::array kLoop{Work::host_strip, Work::host_frame};

// Of messages; none: the wall has none.
std::optional<Wall> wall_of(int type) {
  if (type >= messages::kFirstInternalType) return Wall::sum;
  switch (type) {
    case wire::kTriangles: return Wall::exchange;
    case wire::kStillLines: return Wall::still;
    case wire::kEdge:
    case wire::kBackground:
    case wire::kPicture:
    case wire::kBands: return Wall::bands;
    case wire::kWrite:
    case wire::kRender:
    case wire::kCredit:
    case wire::kStrip:
    case wire::kDrawn:
    case wire::kWritten:
    case wire::kStorage: return Wall::host;
    default: return std::nullopt;
  }
}

void clear(std::vector<double>& costs, std::span<const Work> kinds) {
  for (const Work kind : kinds) costs[static_cast<std::size_t>(kind)] = 0;
}

class Rehearsals {
 public:
  Rehearsals(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting,
             const Forecast& forecast, int threads)
      : tasks_(forecast.most_frames > 0 ? farm::cut_tasks(tasks, forecast.most_frames) : tasks),
        cut_(tasks_.size() > tasks.size() ? std::optional(cut_counts(counts, tasks, tasks_)) : std::nullopt),
        counts_(cut_ ? *cut_ : counts),
        plan_{tasks_, farm::make_groups(forecast.nodes, static_cast<int>(forecast.groups), tasks_.size()),
              forecast.contributors, forecast.sharers},
        setting_(setting),
        nodes_(forecast.nodes),
        threads_(threads) {}

  // Times without walls, each by its place.
  std::vector<double> seconds(const std::vector<Walls>& all) {
    rehearse_uneven(all);
    std::vector<double> found(all.size());
    side_by_side(all.size(), threads_, [&](std::size_t i) { found[i] = seconds(all[i]); });
    return found;
  }

  // What others take no time in any case.
  Walls there() const {
    const bool several = std::ranges::any_of(plan_.groups, [](const auto& group) { return group.count > 1; });
    const bool far = several && plan_.groups.front().count > setting_.platform.machine.nodes;
    Walls there{Wall::compute, Wall::host};
    if (nodes_ > 1) there.add(Wall::frame);
    if (several) there.add(Wall::imbalance).add(Wall::sum);
    if (far) there.add(Wall::exchange).add(Wall::still);
    if (several && setting_.nodes_write()) there.add(Wall::bands);
    if (setting_.files) there.add(Wall::encoder).add(Wall::storage);
    return there;
  }

 private:
  // What a rehearsal is kept for.
  struct Uneven {
    double seconds;
    std::vector<walls::Busy> busy;
  };

  // Nodes that have no frame left help others of the rehearsal in which none helps.
  double seconds(Walls removed) {
    const Uneven& uneven = uneven_.at(removed.without({Wall::frame}).number());
    if (!removed.has(Wall::frame)) return uneven.seconds;
    const std::vector<walls::Pace> paces = walls::even_out(uneven.busy, plan_.groups);
    const bool helps =
        std::ranges::any_of(paces, [](const walls::Pace& pace) { return pace.keyframes != 1 || pace.inbetweens != 1; });
    return helps ? rehearsed(removed, paces).seconds : uneven.seconds;
  }

  void rehearse_uneven(const std::vector<Walls>& all) {
    std::map<unsigned long, Walls> missing;
    for (const Walls each : all) {
      const Walls removed = each.without({Wall::frame});
      if (!uneven_.contains(removed.number())) missing.emplace(removed.number(), removed);
    }
    std::vector<Walls> fresh;
    for (const auto& [number, removed] : missing) fresh.push_back(removed);
    std::vector<Uneven> found(fresh.size());
    side_by_side(fresh.size(), threads_, [&](std::size_t i) {
      Rehearsed run = rehearsed(fresh[i], {});
      found[i] = {run.seconds, std::move(run.busy)};
    });
    for (std::size_t i = 0; i < fresh.size(); ++i) uneven_.emplace(fresh[i].number(), std::move(found[i]));
  }

  Rehearsed rehearsed(Walls removed, std::vector<walls::Pace> paces) {
    const experiments::Platform platform = without(setting_.platform, removed, setting_.writers);
    Setting setting{setting_.film, platform};
    setting.mapping = setting_.mapping;
    setting.picture = setting_.picture;
    setting.layers = setting_.layers;
    setting.files = setting_.files;
    setting.writers = setting_.writers;
    setting.exchange = setting_.exchange;
    setting.sink_threads = setting_.sink_threads;
    setting.host_budget = setting_.host_budget;
    setting.even = {removed.has(Wall::imbalance), std::move(paces)};
    return rehearse(counts_, plan_, setting, nodes_, loads_);
  }

  const std::vector<farm::Task> tasks_;
  const std::optional<FilmCounts> cut_;
  const FilmCounts& counts_;
  const farm::Plan plan_;
  const Setting& setting_;
  const int nodes_;
  const int threads_;
  KeyframeLoads loads_;
  std::map<unsigned long, Uneven> uneven_;  // by the walls that are removed, of which `one frame` is none
};

}  // namespace

std::string unidentified_text(const FilmCounts& counts, const Setting& setting) {
  return experiments::unidentified_text(setting.platform, FrameCosts(setting, 1).kinds_of_work(counts));
}

experiments::Platform without(experiments::Platform platform, Walls walls, Writers writers) {
  simulated::Machine& machine = platform.machine;
  const auto kind = [&](std::size_t first) { return machine.work.begin() + static_cast<std::ptrdiff_t>(first); };
  if (walls.has(Wall::compute)) std::fill(kind(0), kind(wire::kNodeKinds), 0);
  if (walls.has(Wall::host)) clear(machine.work, kLoop);
  if (walls.has(writers == Writers::nodes ? Wall::encoder : Wall::host)) clear(machine.work, kComposing);
  if (walls.has(Wall::encoder)) std::fill(kind(static_cast<std::size_t>(Work::file)), machine.work.end(), 0);
  if (walls.has(Wall::storage)) machine.storage = {};
  machine.network.is_free = [walls](int type) {
    const std::optional<Wall> wall = wall_of(type);
    return wall && walls.has(*wall);
  };
  return platform;
}

walls::Explanation explain(const FilmCounts& counts, const std::vector<farm::Task>& tasks, const Setting& setting,
                           const Forecast& forecast, int threads) {
  Rehearsals rehearsals(counts, tasks, setting, forecast, threads);
  const auto seconds = [&](const std::vector<Walls>& all) {
    std::vector<double> found = rehearsals.seconds(all);
    for (double& each : found) each *= forecast.middle;
    return found;
  };
  return walls::explain(walls::AllSecondsWithout(seconds), rehearsals.there());
}

}  // namespace mars::forecast
