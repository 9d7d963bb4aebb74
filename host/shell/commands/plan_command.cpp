#include "host/shell/commands/plan_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "host/child/programs.h"
#include "host/content/document/text.h"
#include "host/experiments/forecast/forecast.h"
#include "host/images/picture_format.h"
#include "host/shell/job/film_of.h"
#include "host/shell/options/render_options.h"
#include "topology/machine.h"

namespace mars::commands {
namespace {

constexpr double kCounting = 0.5;  // seconds, about

struct Words {
  options::RenderOptions options;
  bool json = false;
};

std::string megabytes(double bytes) { return document::formatted("%.1f MB", bytes / 1e6); }

void plan(const Words& words, const forecast::MakeCounter& make_counter) {
  const options::RenderOptions& options = words.options;
  const film::CompiledFilm film = job::load_film_of(
      options, [](const std::string& line) { std::cerr << "mars: warning: " << line << '\n'; });
  const wire::FilmView view = film.view();
  const std::string platform_name = options.platform.empty() ? "here" : options.platform;
  const experiments::Platform platform =
      experiments::read_platform(platform_name, experiments::platforms_folder(child::own_file()));
  const std::vector<farm::Task> tasks =
      farm::make_tasks(view, options.frames.of_film(view.settings().frames), !options.no_coherence);
  const forecast::FilmCounts counts = forecast::count_film(view, tasks, *make_counter(view), {kCounting});
  const forecast::Setting setting{view, platform, options.mapping, images::facts_of(options.format).pixels};
  const int nodes = options.nodes == 0 ? topology::Machine::here().processors() : static_cast<int>(options.nodes);
  const forecast::Forecast f = forecast::forecast(counts, tasks, setting, nodes, options.groups);
  std::cout << document::formatted("nodes %d groups %u seconds %.6f to_nodes %.0f to_host %.0f memory %.0f counted %zu\n",
                                   f.nodes, f.groups, f.run.seconds, f.run.bytes_to_nodes, f.run.bytes_to_host,
                                   f.run.node_memory, counts.counted);
}

}  // namespace

void add_plan(CLI::App& app, const forecast::MakeCounter& make_counter) {
  const auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("plan", "Forecast a rendering's time, memory and bytes");
  options::add_render_options(*command, words->options, options::Program::plan);
  command->add_flag("--json", words->json, "Print one JSON object, for programs. Example: --json");
  command->callback([words, make_counter] { plan(*words, make_counter); });
}

}  // namespace mars::commands
