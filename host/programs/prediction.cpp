#include "host/programs/prediction.h"

#include <algorithm>
#include <filesystem>
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

forecast::Setting setting_of(const session::RenderJob& job, const wire::FilmView& film,
                             const experiments::Platform& platform) {
  forecast::Setting setting{film, platform, job.mapping, job.format};
  setting.files = !job.folder.empty() || job.counts_files;
  if (job.writers == session::Writers::nodes) setting.writers = forecast::Writers::nodes;
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

session::Prediction predict(const session::RenderJob& job, const experiments::Platform& platform,
                            const wire::FilmView& film, const farm::PlanRequest& request, int nodes) {
  const std::vector<farm::Task> tasks = farm::make_tasks(film, request.frames, request.coherence);
  const forecast::FilmCounts counts =
      forecast::count_film(film, tasks, *make_node_counter(film), {kMostCounting, kCountedPart / nodes}, job.format);
  forecast::Forecast best = forecast::forecast(counts, tasks, setting_of(job, film, platform), nodes, request.groups);
  return {best.groups, best.contributors, course_of(std::move(best))};
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
session::Prediction predict_here(const session::RenderJob& job, const wire::FilmView& film,
                                 const farm::PlanRequest& request, int nodes) {
  const std::optional<experiments::Platform> calibrated = calibrated_here();
  const experiments::Platform platform = calibrated ? *calibrated : like_here("reference");
  farm::PlanRequest known = request;
  const std::size_t tasks = farm::make_tasks(film, request.frames, request.coherence).size();
  const bool chooses = calibrated && nodes <= platform.machine.processors;
  if (request.groups == 0 && !chooses)
    known.groups = static_cast<std::uint32_t>(farm::make_groups(nodes, 0, tasks).size());
  session::Prediction prediction = predict(job, platform, film, known, nodes);
  if (!chooses) prediction.contributors = 0;
  return prediction;
}

// Seconds that nodes work, very roughly.
double rough_seconds(const wire::FilmView& film, const std::vector<farm::Task>& tasks) {
  double seconds = 0;
  for (const farm::Task& task : tasks) {
    const farm::RoughWork work = farm::rough_work(film, film.intervals()[task.interval]);
    seconds += work.keyframe + static_cast<double>(task.frames.size() - 1) * work.inbetween;
  }
  return seconds;
}

}  // namespace

void predict_on(const experiments::Platform& platform, session::RenderJob& job) {
  job.predict = [platform, job](const wire::FilmView& film, const farm::PlanRequest& request, int nodes) {
    session::Prediction prediction = predict(job, platform, film, request, nodes);
    prediction.warning = experiments::doubt_text(platform);
    return prediction;
  };
}

void render_here(const options::RenderOptions& options, const std::string& backend) {
  if (!options.serve.empty()) return serve::serve({options.serve, backend, options.mapping, options.block});
  session::RenderJob job = job::job_of(options, backend);
  job.predict = [job](const wire::FilmView& film, const farm::PlanRequest& request, int nodes) {
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
