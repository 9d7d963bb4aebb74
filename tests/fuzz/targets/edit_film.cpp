// Words that change films: a word a line, an empty line between commands. The film has a figure and a ball.
#include "host/editing/edit_film.h"

#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::edit_film {
namespace {

const std::filesystem::path& film_path() {
  static const std::filesystem::path path = MARS_FUZZ_FILM;
  return path;
}

std::vector<editing::Command> commands_of(std::string_view input) {
  std::vector<editing::Command> commands(1);
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    if (end == 0)
      commands.emplace_back();
    else
      commands.back().emplace_back(input.substr(0, end));
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  return commands;
}

}  // namespace

void take(std::string_view input) {
  static const document::Json sound = document::read_json(film_path());
  document::Json film = sound;
  editing::edit_film(film, film_path(), commands_of(input));
}

const Target target("edit_film", Form::text, take);

}  // namespace mars::fuzz::edit_film
