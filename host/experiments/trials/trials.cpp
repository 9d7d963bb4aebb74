#include "host/experiments/trials/trials.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "host/content/document/whole_file.h"
#include "host/content/film/compile.h"
#include "host/experiments/forecast/forecast.h"
#include "host/render/session/session.h"

namespace mars::trials {
namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 0.3;                    // about, that a trial on one node takes: its start counts little
constexpr std::size_t kFewest = 2;                  // frames
constexpr forecast::Budget kGlance{0.05}, kAll{2};  // seconds

// A film and as many of its first frames as take kSeconds.
class Trial {
 public:
  Trial(const TrialTask& task, const TrialFilm& film)
      : task_(task), file_(task.renderer.folder / (film.name + ".json")) {
    document::write_whole_file(file_, film.text);
    film_ = film::load_film(file_);
    const std::size_t all = film_.view().settings().frames;
    count(all, kGlance);
    const double enough = std::round(static_cast<double>(all) * kSeconds / forecast(1, false).run.seconds);
    count(static_cast<std::size_t>(std::clamp(enough, static_cast<double>(kFewest), static_cast<double>(all))), kAll);
  }

  // What it took over what was forecast.
  double ratio(int nodes, bool files) const {
    const forecast::Forecast expected = forecast(nodes, files);
    const fs::path folder = task_.renderer.folder / "frames";
    const std::vector<std::string> words{"--nodes",
                                         std::to_string(nodes),
                                         "--groups",
                                         std::to_string(expected.groups),
                                         "--frames",
                                         "0-" + std::to_string(frames_ - 1),
                                         files ? "-o" : "--sink",
                                         files ? folder.string() : "none"};
    const nlohmann::json report = experiments::report_of_run(task_.renderer, file_, words);
    fs::remove_all(folder);
    return report.at("total_seconds").get<double>() / expected.run.seconds;
  }

 private:
  void count(std::size_t frames, const forecast::Budget& budget) {
    const wire::PackedFilm film = film_.view();
    std::vector<std::uint32_t> first(frames);
    std::iota(first.begin(), first.end(), 0u);
    frames_ = frames;
    tasks_ = farm::make_tasks(film, first, true);
    counts_ = forecast::count_film(film, tasks_, *task_.make_counter(film, forecast::Lines::some), budget,
                                   images::PictureFormat::png);
  }

  forecast::Forecast forecast(int nodes, bool files) const {
    const wire::PackedFilm film = film_.view();
    const experiments::Platform& platform = task_.platform;
    forecast::Setting setting{film, platform};
    setting.files = files;
    setting.sink_threads = session::sink_threads({platform.host_memory, platform.host_processors()});
    setting.host_budget = platform.host_memory;
    return forecast::forecast(counts_, tasks_, setting, nodes, 0);
  }

  const TrialTask& task_;
  const fs::path file_;
  film::CompiledFilm film_;
  std::size_t frames_ = 0;  // of the film, the first ones
  std::vector<farm::Task> tasks_;
  forecast::FilmCounts counts_;
};

}  // namespace

std::vector<int> tried_nodes(int processors) {
  std::vector<int> nodes{1, std::min(2, processors), processors};
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<experiments::Spread> try_forecasts(const TrialTask& task) {
  struct Setup {
    int nodes;
    bool files;
    std::vector<double> ratios{};
  };
  std::vector<Setup> setups;
  for (const bool files : {false, true})
    for (const int nodes : tried_nodes(task.platform.machine.processors)) setups.push_back({nodes, files});
  int done = 0;
  for (const TrialFilm& film : task.films) {
    const Trial trial(task, film);
    for (Setup& setup : setups) {
      setup.ratios.push_back(trial.ratio(setup.nodes, setup.files));
      if (task.progress) task.progress(++done, static_cast<int>(task.films.size() * setups.size()));
    }
  }
  std::vector<experiments::Spread> spreads;
  for (Setup& setup : setups) spreads.push_back(experiments::spread_of(setup.nodes, setup.files, setup.ratios));
  return spreads;
}

}  // namespace mars::trials
