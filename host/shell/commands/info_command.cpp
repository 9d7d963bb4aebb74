#include "host/shell/commands/info_command.h"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "host/cli/command.h"
#include "host/content/film/describe.h"
#include "host/render/report/describe.h"
#include "host/shell/job/film_of.h"
#include "host/shell/options/render_options.h"

namespace mars::commands {
namespace {

std::string info_of(const std::string& path) {
  if (const auto report = report::read_report(path)) return report::describe(*report, path);
  options::RenderOptions options;
  options.film = path;
  std::string warnings;
  const film::CompiledFilm film =
      job::load_film_of(options, [&](const std::string& line) { warnings += "warning     " + line + "\n"; });
  return film::describe(film) + warnings;
}

}  // namespace

void add_info(cli::Command app) {
  const auto film = std::make_shared<std::string>();
  const cli::Command command = app.add_command("info", "Print what a film contains, or what bound a run");
  command.add("FILM", *film, "A .json or .mars file, or a report of mars render. Example: examples/demo.json")
      .required();
  command.runs([film] { std::cout << info_of(*film); });
}

}  // namespace mars::commands
