#include "tests/host/experiments/forecast/simulated_film.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "hal/nx/nx_messages.h"
#include "hal/simulated/run_simulated.h"
#include "host/content/film/frame_set.h"
#include "host/programs/counted_writer.h"
#include "host/programs/node_counter.h"
#include "host/programs/simulated_files.h"
#include "host/render/farm/assembly.h"
#include "host/render/sinks/counted_files.h"
#include "node/firmware.h"
#include "tests/temporary_folder.h"

namespace mars::forecast {
namespace {

film::CompiledFilm small_film(const std::string& name, Files files, const std::string& light_patch) {
  film::CompileOptions options;
  options.size = files == Files::none ? std::array<std::uint32_t, 2>{160, 90} : std::array<std::uint32_t, 2>{640, 360};
  const auto path = std::filesystem::path(MARS_SOURCE_DIR) / "examples" / (name + ".json");
  if (light_patch.empty()) return film::load_film(path, options);
  std::ifstream file(path);
  nlohmann::json film = nlohmann::json::parse(file);
  for (nlohmann::json& light : film["lights"])
    if (light.contains("shadow")) light.merge_patch(nlohmann::json::parse(light_patch));
  const test::TemporaryFolder folder;
  const auto changed = folder / "lit.json";
  std::ofstream(changed) << film;
  return film::load_film(changed, options);
}

}  // namespace

SimulatedFilm::SimulatedFilm(const std::string& name, const std::string& frames, const std::string& platform,
                             Files files, const std::string& light)
    : files_(files),
      film_(small_film(name, files, light)),
      platform_(experiments::read_platform(platform, std::string(MARS_SOURCE_DIR) + "/cluster/platforms")),
      tasks_(farm::make_tasks(view(), film::FrameSet(frames).of_film(view().settings().frames), true)),
      counts_(count_film(view(), tasks_, *programs::make_node_counter(view(), Lines::some), {10},
                         images::PictureFormat::png)) {}

Setting SimulatedFilm::setting(const wire::PackedFilm& film) const {
  Setting setting{film, platform_};
  setting.files = files_ != Files::none;
  setting.exchange = exchange_;
  setting.writers = files_ == Files::nodes ? Writers::nodes : Writers::host;
  setting.sink_threads = static_cast<std::uint32_t>(platform_.host_processors());
  return setting;
}

Forecast SimulatedFilm::forecast(int nodes, std::uint32_t groups, std::int32_t sharers,
                                 std::uint32_t most_frames) const {
  const wire::PackedFilm film = view();
  Setting setting = this->setting(film);
  setting.sharers = sharers;
  setting.most_frames = most_frames;
  return forecast::forecast(counts_, tasks_, setting, nodes, groups);
}

FilmCounts SimulatedFilm::count_exactly() const {
  return forecast::count_exactly(view(), tasks_, programs::make_node_counter, images::PictureFormat::png, 2, {});
}

walls::Explanation SimulatedFilm::explain(int nodes, std::uint32_t groups) const {
  const wire::PackedFilm film = view();
  Forecast all;
  all.nodes = nodes;
  all.groups = groups;
  return forecast::explain(counts_, tasks_, setting(film), all, 1);
}

Rehearsed SimulatedFilm::counted(int nodes, std::uint32_t groups) const {
  const wire::PackedFilm film = view();
  if (!exact_) exact_ = count_exactly();
  return rehearse(*exact_, plan(nodes, groups), setting(film), nodes);
}

farm::Plan SimulatedFilm::plan(int nodes, std::uint32_t groups) const {
  return {tasks_, farm::make_groups(nodes, static_cast<int>(groups), tasks_.size())};
}

farm::FarmReport SimulatedFilm::render(int nodes, std::uint32_t groups) const {
  return render(Forecast{.nodes = nodes, .groups = groups, .run = {}, .spread = {}});
}

farm::FarmReport SimulatedFilm::render(const Forecast& forecast) const {
  const int nodes = forecast.nodes;
  const farm::Plan plan{farm::cut_tasks(tasks_, forecast.most_frames > 0 ? forecast.most_frames : kUncut),
                        farm::make_groups(nodes, static_cast<int>(forecast.groups), tasks_.size()),
                        forecast.contributors, forecast.sharers};
  const wire::FilmSettings& settings = view().settings();
  const images::PictureBands bands(images::PictureFormat::png, settings.width, settings.height);
  farm::FarmReport report;
  simulated::World* the_world = nullptr;
  const auto host = [&](simulated::World& world) {
    the_world = &world;
    report = render(plan, nodes, world);
  };
  const auto make_writer = [&](const wire::PackedFilm&, std::span<const std::byte>) {
    return std::make_unique<programs::CountedWriter>(bands, platform_, *the_world, static_cast<int>(mynode()));
  };
  simulated::run_simulated(platform_.machine, nodes, host, [&] {
    node::run_node({.host = "simulated",
                    .binding = "",
                    .seat = {-1, -1, -1, -1, -1},
                    .memory = platform_.memory,
                    .simd = "",
                    .make_frame_writer = make_writer});
  });
  return report;
}

farm::FarmReport SimulatedFilm::render(const farm::Plan& plan, int nodes, simulated::World& world) const {
  const wire::PackedFilm film = view();
  const Setting setting = this->setting(film);
  const wire::FilmSettings& settings = film.settings();
  const farm::HostMemory memory =
      farm::share_host_memory(setting.host_budget, settings, setting.pixels(), static_cast<std::uint32_t>(nodes),
                              static_cast<std::uint32_t>(plan.groups.size()), setting.sink_threads);
  sinks::NullSink none;
  sinks::CountedFiles files({setting.picture, settings.width, settings.height}, platform_.file_part);
  sinks::ServedSinks sinks(files_ == Files::host ? static_cast<sinks::Sink&>(files) : none,
                           {settings.width, settings.height, 16, memory.frames, setting.sink_threads,
                            farm::background_pixel(film, film.intervals().front(), setting.pixels()), setting.pixels()},
                           programs::serve_files(world, setting.picture));
  farm::FarmOptions options;
  const farm::Writing writing = programs::counted_writing();
  if (files_ == Files::nodes) options.writing = &writing;
  options.credits = memory.credits;
  options.exchange = exchange_;
  options.each_frame = true;
  return farm::render_film(film_.block(), plan, options, sinks, {});
}

}  // namespace mars::forecast
