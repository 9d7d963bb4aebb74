#include "host/programs/prediction.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "hal/failure/failure.h"
#include "host/child/programs.h"
#include "host/experiments/forecast/forecast.h"
#include "host/programs/node_counter.h"
#include "host/render/farm/rough_work.h"
#include "host/render/serve/server.h"
#include "host/shell/job/render_job.h"
#include "topology/machine.h"

namespace mars::programs {
namespace {

constexpr double kMostCounting = 0.5;  // seconds
constexpr double kCountedPart = 0.1;   // of counting all frames, of what each node would do of it
constexpr double kSoon = 1.0;          // seconds, about: not worth a forecast

forecast::Setting setting_of(const session::RenderJob& job, const wire::PackedFilm& film,
                             const experiments::Platform& platform) {
  forecast::Setting setting{film, platform, job.mapping, job.form.format, job.form.layers};
  setting.exchange = job.exchange;
  setting.files = !job.folder.empty() || job.counts_files;
  if (job.writers == session::Writers::nodes) setting.writers = forecast::Writers::nodes;
  setting.sharers = job.sharers;
  setting.most_frames = job.most_frames;
  const session::HostMachine host = session::host_machine(job.host);
  setting.host_budget = host.memory;
  setting.sink_threads = session::sink_threads(host);
  return setting;
}

events::Course course_of(forecast::Forecast forecast) {
  std::vector<events::ExpectedFrame> frames = std::move(forecast.run.frames);
  if (!forecast.spread) return events::Course(std::move(frames));
  const experiments::Spread& spread = *forecast.spread;
  for (events::ExpectedFrame& frame : frames) frame.seconds *= spread.middle;
  return events::Course(std::move(frames),
                        events::RatioBounds{spread.low / spread.middle, spread.high / spread.middle});
}

struct Counted {
  std::vector<farm::Task> tasks;
  forecast::FilmCounts counts;
};

Counted count(const session::RenderJob& job, const wire::PackedFilm& film, const farm::PlanRequest& request,
              int nodes) {
  std::vector<farm::Task> tasks = farm::make_tasks(film, request.frames, request.coherence);
  const forecast::Budget budget{kMostCounting, kCountedPart / nodes};
  forecast::FilmCounts counts =
      forecast::count_film(film, tasks, *make_node_counter(film, forecast::Lines::some), budget, job.form.format);
  return {std::move(tasks), std::move(counts)};
}

session::Prediction predict(const Counted& counted, const forecast::Setting& setting, std::uint32_t groups, int nodes) {
  forecast::Forecast best = forecast::forecast(counted.counts, counted.tasks, setting, nodes, groups);
  return {best.groups, best.contributors, best.sharers, best.most_frames, course_of(std::move(best))};
}

// How machines are joined is not known: the links are taken as those of Gigabit Ethernet.
experiments::Platform several_machines(const experiments::Platform& one, int nodes_a_machine) {
  experiments::Platform several = one;
  several.machine.nodes = nodes_a_machine;
  several.machine.network =
      experiments::read_platform("ethernet", experiments::platforms_folder(child::own_file())).machine.network;
  return several;
}

bool nodes_write_sooner(const Counted& counted, forecast::Setting setting, std::uint32_t groups, int nodes) {
  const auto seconds = [&](forecast::Writers writers) {
    setting.writers = writers;
    return forecast::forecast(counted.counts, counted.tasks, setting, nodes, groups).seconds();
  };
  return seconds(forecast::Writers::nodes) < seconds(forecast::Writers::host);
}

experiments::Platform like_here(const std::string& name) {
  return experiments::like_here(name, experiments::platforms_folder(child::own_file()),
                                topology::Machine::here().processors());
}

// What mars calibrate measured; none where nothing was, or where that cannot be trusted.
std::optional<experiments::Platform> calibrated_here() {
  if (!std::filesystem::exists(experiments::calibrated_platform())) return std::nullopt;
  experiments::Platform platform = like_here("here");
  return platform.doubt.empty() ? std::optional(std::move(platform)) : std::nullopt;
}

// Of a rendering on this machine, and perhaps on others: then it is not known how these are joined.
session::Prediction predict_here(const session::RenderJob& job, const wire::PackedFilm& film,
                                 const farm::PlanRequest& request, int nodes) {
  const std::optional<experiments::Platform> calibrated = calibrated_here();
  const experiments::Platform platform = calibrated ? *calibrated : like_here("reference");
  const auto counted = std::make_shared<const Counted>(count(job, film, request, nodes));
  const bool chooses = calibrated && nodes <= platform.machine.processors;
  std::uint32_t groups = request.groups;
  if (groups == 0 && !chooses)
    groups = static_cast<std::uint32_t>(farm::make_groups(nodes, 0, counted->tasks.size()).size());
  forecast::Setting setting = setting_of(job, film, platform);
  if (!chooses) {
    setting.sharers = std::max(setting.sharers, 1);
    if (setting.most_frames == 0) setting.most_frames = forecast::kUncut;
  }
  session::Prediction prediction = predict(*counted, setting, groups, nodes);
  if (!chooses) prediction.contributors = 0;
  prediction.nodes_write_sooner = [=](int nodes_a_machine) {
    const experiments::Platform several = several_machines(platform, nodes_a_machine);
    return nodes_write_sooner(*counted, setting_of(job, film, several), groups, nodes);
  };
  return prediction;
}

// Seconds that nodes work, very roughly.
double rough_seconds(const wire::PackedFilm& film, const std::vector<farm::Task>& tasks) {
  double seconds = 0;
  for (const farm::Task& task : tasks) {
    const farm::RoughWork work = farm::rough_work(film, film.intervals()[task.interval]);
    seconds += work.keyframe + static_cast<double>(task.frames.size() - 1) * work.inbetween;
  }
  return seconds;
}

}  // namespace

void predict_on(const experiments::Platform& platform, session::RenderJob& job) {
  job.predict = [platform, job](const wire::PackedFilm& film, const farm::PlanRequest& request, int nodes) {
    session::Prediction prediction =
        predict(count(job, film, request, nodes), setting_of(job, film, platform), request.groups, nodes);
    prediction.warning = experiments::doubt_text(platform);
    return prediction;
  };
}

void render_here(const options::RenderOptions& options, const std::string& backend) {
  if (!options.serve.empty()) return serve::serve({options.serve, backend, options.mapping, options.block});
  session::RenderJob job = job::job_of(options, backend);
  job.predict = [job](const wire::PackedFilm& film, const farm::PlanRequest& request, int nodes) {
    const std::vector<farm::Task> tasks = farm::make_tasks(film, request.frames, request.coherence);
    if (rough_seconds(film, tasks) / nodes < kSoon) return session::Prediction();
    try {
      return predict_here(job, film, request, nodes);
    } catch (const Failure& failure) {  // of a platform's file: the rendering needs no forecast
      return session::Prediction{.warning = failure.what()};
    }
  };
  session::run_session(job);
}

}  // namespace mars::programs
