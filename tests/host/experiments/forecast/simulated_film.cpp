#include "tests/host/experiments/forecast/simulated_film.h"

#include <array>

#include "hal/simulated/run_simulated.h"
#include "host/content/film/frame_set.h"
#include "host/programs/node_counter.h"
#include "host/render/sinks/served_sinks.h"
#include "node/firmware.h"

namespace mars::forecast {
namespace {

film::CompiledFilm small_film(const std::string& name) {
  film::CompileOptions options;
  options.size = std::array<std::uint32_t, 2>{160, 90};
  return film::load_film(std::string(MARS_SOURCE_DIR) + "/examples/" + name + ".json", options);
}

}  // namespace

SimulatedFilm::SimulatedFilm(const std::string& name, const std::string& frames, const std::string& platform)
    : film_(small_film(name)),
      platform_(experiments::read_platform(platform, std::string(MARS_SOURCE_DIR) + "/cluster/platforms")),
      tasks_(farm::make_tasks(view(), film::FrameSet(frames).of_film(view().settings().frames), true)),
      counts_(count_film(view(), tasks_, *programs::make_node_counter(view()), {10}, images::PictureFormat::png)) {}

Setting SimulatedFilm::setting(const wire::FilmView& film) const {
  Setting setting{film, platform_};
  setting.files = false;
  return setting;
}

Forecast SimulatedFilm::forecast(int nodes, std::uint32_t groups) const {
  const wire::FilmView film = view();
  return forecast::forecast(counts_, tasks_, setting(film), nodes, groups);
}

farm::FarmReport SimulatedFilm::render(int nodes, std::uint32_t groups) const {
  const wire::FilmView film = view();
  const farm::Plan plan{tasks_, farm::make_groups(nodes, static_cast<int>(groups), tasks_.size())};
  const Setting setting = this->setting(film);
  const wire::FilmSettings& settings = film.settings();
  const farm::HostMemory memory =
      farm::share_host_memory(setting.host_budget, settings, setting.pixels(), static_cast<std::uint32_t>(nodes),
                              static_cast<std::uint32_t>(plan.groups.size()), setting.sink_threads);
  farm::FarmReport report;
  const auto host = [&](simulated::World& world) {
    sinks::NullSink sink;
    sinks::ServedSinks sinks(sink, {settings.width, settings.height, 16, memory.frames, setting.sink_threads},
                             [&](const images::FileWork&) { return world.clock(nodes); });
    farm::FarmOptions options;
    options.credits = memory.credits;
    options.each_frame = true;
    report = farm::render_film(film_.block(), plan, options, sinks, {});
  };
  simulated::run_simulated(platform_.machine, nodes, host, [&] {
    node::run_node({"simulated", "", {-1, -1, -1, -1, -1}, platform_.memory, ""});
  });
  return report;
}

}  // namespace mars::forecast
