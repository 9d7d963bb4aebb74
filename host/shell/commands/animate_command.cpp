#include "host/shell/commands/animate_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "host/editing/words.h"
#include "host/shell/commands/film_on_disk.h"

namespace mars::commands {

void add_animate(CLI::App& app, int& code) {
  const auto film = std::make_shared<FilmOnDisk>();
  CLI::App& animate = editing::add_animate(app, *film, code);
  animate.add_option("FILM", film->name, "The film file, changed in place. Example: film.json")->required();
  animate.parse_complete_callback([film] {});  // keeps it
}

}  // namespace mars::commands
