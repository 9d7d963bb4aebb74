#include "host/shell/commands/animate_command.h"

#include <memory>

#include "host/cli/command.h"
#include "host/editing/words.h"
#include "host/shell/commands/film_on_disk.h"

namespace mars::commands {

void add_animate(cli::Command app, int& code) {
  const auto film = std::make_shared<FilmOnDisk>();
  cli::Command animate = editing::add_animate(app, *film, code);
  animate.add("FILM", film->name, "The film file, changed in place. Example: film.json").required();
  animate.keeps(film);
}

}  // namespace mars::commands
