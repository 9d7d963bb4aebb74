#include "host/shell/commands/film_command.h"

#include <memory>

#include "host/cli/command.h"
#include "host/editing/words.h"
#include "host/shell/commands/film_on_disk.h"

namespace mars::commands {

void add_film(cli::Command app) {
  const auto film = std::make_shared<FilmOnDisk>();
  cli::Command words = editing::add_film(app, *film);
  words.add("FILM", film->name, "The film file, changed in place. Example: film.json").required();
  words.keeps(film);
}

}  // namespace mars::commands
