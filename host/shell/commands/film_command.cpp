#include "host/shell/commands/film_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "host/editing/words.h"
#include "host/shell/commands/film_on_disk.h"

namespace mars::commands {

void add_film(CLI::App& app) {
  const auto film = std::make_shared<FilmOnDisk>();
  CLI::App& words = editing::add_film(app, *film);
  words.add_option("FILM", film->name, "The film file, changed in place. Example: film.json")->required();
  words.parse_complete_callback([film] {});  // keeps it
}

}  // namespace mars::commands
